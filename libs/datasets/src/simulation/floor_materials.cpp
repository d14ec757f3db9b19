// SPDX-License-Identifier: BSD-3-Clause
#include "materials.h"

namespace vmcl {

void paintPlanks(const Canvas& canvas, const cv::Scalar& color) {
  constexpr double board = 0.14, gap = 0.008;
  canvas.fill(shaded(color, 0.45));
  Random& random = canvas.random();
  for (double y = 0; y < canvas.height(); y += board)
    for (double x = random.uniform(-1.5, 0); x < canvas.width();) {
      const double length = random.uniform(0.8, 1.8);
      const Canvas plank = canvas.part(x, y, length - gap, board - gap);
      plank.fill(varied(color, 0.15, random));
      plank.mottle(0.12, 0.5, 0.02);
      x += length;
    }
}

void paintTiles(const Canvas& canvas, const cv::Scalar& color) {
  constexpr double side = 0.33, joint = 0.01;
  canvas.fill(shaded(color, 0.6));
  for (double y = 0; y < canvas.height(); y += side)
    for (double x = 0; x < canvas.width(); x += side) {
      const Canvas tile = canvas.part(x, y, side - joint, side - joint);
      tile.fill(varied(color, 0.08, canvas.random()));
      tile.mottle(0.1, 0.12, 0.12);
    }
}

void paintCarpet(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.1, 0.25, 0.25);
  Random& random = canvas.random();
  const int motifs = static_cast<int>(canvas.width() * canvas.height() * 5);
  for (int i = 0; i < motifs; ++i) {
    const double x = random.uniform(0, canvas.width()), y = random.uniform(0, canvas.height());
    const double size = random.uniform(0.04, 0.14);
    const cv::Scalar motif = varied(color, 0.45, random);
    canvas.polygon({{x - size, y}, {x, y + 0.6 * size}, {x + size, y}, {x, y - 0.6 * size}}, motif);
  }
  canvas.mottle(0.08, 0.02, 0.02);
}

void paintCeiling(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.03, 0.8, 0.8);
  for (double y = 1.2; y < canvas.height(); y += 2.4)
    for (double x = 1.2; x < canvas.width(); x += 2.4) {
      canvas.ellipse(x, y, 0.19, 0.19, 0, {150, 155, 160});
      canvas.ellipse(x, y, 0.17, 0.17, 0, {255, 255, 255});
    }
}

}  // namespace vmcl
