// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "materials.h"

namespace vmcl {

void paintCeilingPanels(const Canvas& canvas, const cv::Scalar& color) {
  constexpr double side = 0.6;
  canvas.fill(shaded(color, 0.75));
  for (double y = 0; y < canvas.height(); y += side)
    for (double x = 0; x < canvas.width(); x += side) {
      const Canvas panel = canvas.part(x + 0.008, y + 0.008, side - 0.016, side - 0.016);
      panel.fill(color);
      panel.mottle(0.05, 0.02, 0.02);
    }
}

void paintBlankWall(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.012, 0.8, 0.8);
  canvas.rectangle(0, 0, canvas.width(), 0.07, shaded(color, 0.55));
}

void paintOfficeCarpet(const Canvas& canvas, const cv::Scalar& color) {
  constexpr double side = 0.5;
  Random& random = canvas.random();
  for (int row = 0; row * side < canvas.height(); ++row)
    for (int column = 0; column * side < canvas.width(); ++column) {
      const Canvas tile = canvas.part(column * side, row * side, side, side);
      tile.fill(varied(color, 0.05, random));
      tile.mottle(0.06, (row + column) % 2 ? 0.01 : 0.1, (row + column) % 2 ? 0.1 : 0.01);
    }
  canvas.mottle(0.06, 0.015, 0.015);
}

void paintLockers(const Canvas& canvas, const cv::Scalar& color) {
  constexpr double wide = 0.4;
  canvas.fill(shaded(color, 0.6));
  for (double x = 0; x < canvas.width(); x += wide)
    for (double y = 0; y < canvas.height(); y += canvas.height() / 2) {
      const Canvas door = canvas.part(x + 0.006, y + 0.006, wide - 0.012, canvas.height() / 2 - 0.012);
      door.fill(varied(color, 0.04, canvas.random()));
      for (int slot = 0; slot < 3; ++slot)
        door.rectangle(0.12, door.height() - 0.12 - 0.025 * slot, 0.15, 0.008, shaded(color, 0.4));
      door.rectangle(0.32, 0.5 * door.height(), 0.02, 0.1, {60, 60, 60});
    }
}

void paintWhiteboard(const Canvas& canvas, const cv::Scalar& color) {
  Random& random = canvas.random();
  canvas.fill({150, 150, 150});
  const Canvas board = canvas.part(0.03, 0.03, canvas.width() - 0.06, canvas.height() - 0.06);
  board.fill(color);
  const cv::Scalar pens[] = {{150, 60, 40}, {40, 40, 180}, {50, 50, 50}, {60, 130, 40}};
  for (int i = 0; i < 12; ++i) {
    const cv::Scalar pen = pens[random.below(4)];
    const double x = random.uniform(0.05, 0.7) * board.width(), y = random.uniform(0.1, 0.9) * board.height();
    std::string word;
    for (int letter = 0; letter < 9; ++letter) word += static_cast<char>('a' + random.below(26));
    if (random.uniform() < 0.6)
      board.text(x, y, random.uniform(0.03, 0.07), word, pen);
    else
      board.ellipse(x, y, random.uniform(0.05, 0.15), random.uniform(0.03, 0.1), random.uniform(0, 90),
                    shaded(pen, 1.3));
    board.line(x, y - 0.03, x + random.uniform(0.1, 0.4), y + random.uniform(-0.1, 0.1), 0.008, pen);
  }
}

}  // namespace vmcl
