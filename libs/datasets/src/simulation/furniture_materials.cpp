// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "materials.h"

namespace vmcl {
namespace {

void paintKnob(const Canvas& canvas, double x, double y) {
  canvas.ellipse(x, y - 0.006, 0.02, 0.02, 0, {40, 45, 50});
  canvas.ellipse(x, y, 0.018, 0.018, 0, {150, 190, 205});
}

/// Books side by side on a shelf of the canvas' size.
void paintShelf(const Canvas& shelf) {
  Random& random = shelf.random();
  for (double x = 0.01; x < shelf.width() - 0.05;) {
    const double thickness = random.uniform(0.018, 0.055), tall = shelf.height() * random.uniform(0.55, 0.93);
    if (random.uniform() < 0.08) {
      x += thickness;  // a gap
      continue;
    }
    const Canvas book = shelf.part(x, 0, thickness, tall);
    const cv::Scalar color = randomColor(random), print = randomColor(random);
    book.fill(color);
    book.rectangle(0, tall * random.uniform(0.7, 0.85), thickness, tall * 0.05, print);
    book.rectangle(thickness * 0.3, tall * 0.2, thickness * 0.4, tall * random.uniform(0.2, 0.45), print);
    book.rectangle(0, 0, 0.003, tall, shaded(color, 0.4));
    x += thickness;
  }
}

}  // namespace

void paintWood(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.16, 0.6, 0.012);
  canvas.mottle(0.08, 0.3, 0.1);
}

void paintDrawers(const Canvas& canvas, const cv::Scalar& color) {
  paintWood(canvas, color);
  const int rows = std::max(1, static_cast<int>(canvas.height() / 0.28));
  const int columns = std::max(1, static_cast<int>(canvas.width() / 0.6));
  const double width = canvas.width() / columns, height = canvas.height() / rows;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double x = column * width, y = row * height;
      canvas.rectangle(x + 0.02, y + 0.02, width - 0.04, height - 0.04, shaded(color, 0.45));
      const Canvas front = canvas.part(x + 0.028, y + 0.028, width - 0.056, height - 0.056);
      paintWood(front, varied(color, 0.15, canvas.random()));
      paintKnob(front, front.width() * 0.5, front.height() * 0.6);
    }
}

void paintBooks(const Canvas& canvas, const cv::Scalar& color) {
  constexpr double board = 0.03;
  paintWood(canvas, color);
  const int shelves = std::max(1, static_cast<int>(canvas.height() / 0.34));
  const double pitch = (canvas.height() - board) / shelves;
  for (int i = 0; i < shelves; ++i) {
    const Canvas shelf = canvas.part(board, i * pitch + board, canvas.width() - 2 * board, pitch - board);
    shelf.fill({35, 40, 45});
    paintShelf(shelf);
  }
}

void paintFabric(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  Random& random = canvas.random();
  for (double x = 0; x < canvas.width();) {
    const double stripe = random.uniform(0.02, 0.12);
    canvas.rectangle(x, 0, stripe * 0.6, canvas.height(), varied(color, 0.3, random));
    x += stripe;
  }
  for (double x = 0.7; x < canvas.width() - 0.2; x += 0.7)
    canvas.line(x, 0, x, canvas.height(), 0.012, shaded(color, 0.4));
  canvas.mottle(0.1, 0.15, 0.15);
  canvas.mottle(0.1, 0.01, 0.01);
}

void paintFridge(const Canvas& canvas, const cv::Scalar& color) {
  canvas.gradient(shaded(color, 0.85), color);
  canvas.line(0, canvas.height() * 0.62, canvas.width(), canvas.height() * 0.62, 0.012, shaded(color, 0.4));
  canvas.rectangle(0.05, canvas.height() * 0.68, 0.03, canvas.height() * 0.22, shaded(color, 0.45));
  canvas.rectangle(0.05, canvas.height() * 0.3, 0.03, canvas.height() * 0.26, shaded(color, 0.45));
  Random& random = canvas.random();
  for (int i = 0; i < 8; ++i) {
    const double x = random.uniform(0.12, std::max(0.13, canvas.width() - 0.15));
    const double y = random.uniform(0.3, 0.95) * canvas.height();
    canvas.rectangle(x, y, random.uniform(0.03, 0.12), random.uniform(0.03, 0.12), randomColor(random));
  }
}

void paintCardboard(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.06, 0.3, 0.01);
  Random& random = canvas.random();
  canvas.rectangle(0, canvas.height() * 0.47, canvas.width(), 0.05, shaded(color, 1.25));
  std::string label;
  for (int i = 0; i < 6; ++i) label += static_cast<char>('A' + random.below(26));
  canvas.text(canvas.width() * 0.15, canvas.height() * 0.62, std::min(0.09, canvas.height() * 0.2), label,
              {40, 40, 40});
  for (int i = 0; i < 3; ++i) {
    const double x = random.uniform(0.1, 0.8) * canvas.width(), y = random.uniform(0.08, 0.35) * canvas.height();
    canvas.rectangle(x, y, 0.06, 0.04, randomColor(random));
  }
}

}  // namespace vmcl
