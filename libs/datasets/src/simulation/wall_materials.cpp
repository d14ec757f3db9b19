// SPDX-License-Identifier: BSD-3-Clause
#include "materials.h"

namespace vmcl {
namespace {

void paintSkirting(const Canvas& canvas) {
  canvas.rectangle(0, 0, canvas.width(), 0.08, {228, 232, 235});
  canvas.rectangle(0, 0.08, canvas.width(), 0.008, {150, 155, 160});
}

void paintFlower(const Canvas& canvas, double x, double y, const cv::Scalar& color) {
  Random& random = canvas.random();
  const double size = random.uniform(0.02, 0.05), turn = random.uniform(0, 360);
  const int petals = 4 + static_cast<int>(random.below(4));
  canvas.line(x, y, x + random.uniform(-0.03, 0.03), y - 2.5 * size, 0.006, {80, 120, 70});
  for (int i = 0; i < petals; ++i) {
    const double angle = (turn + 360.0 * i / petals) * CV_PI / 180;
    canvas.ellipse(x + size * std::cos(angle), y + size * std::sin(angle), size * 0.7, size * 0.4, angle * 180 / CV_PI,
                   color);
  }
  canvas.ellipse(x, y, size * 0.45, size * 0.45, 0, {60, 200, 230});
}

}  // namespace

void paintPlain(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.03, 0.3, 0.3);
}

void paintPlaster(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.05, 0.5, 0.5);
  canvas.mottle(0.04, 0.03, 0.03);
  Random& random = canvas.random();
  const int marks = static_cast<int>(canvas.width() * canvas.height() * 2);
  for (int i = 0; i < marks; ++i) {
    const double x = random.uniform(0, canvas.width()), y = random.uniform(0, canvas.height());
    const double dx = random.uniform(-0.08, 0.08), dy = random.uniform(-0.08, 0.08);
    canvas.line(x, y, x + dx, y + dy, 0.003, shaded(color, random.uniform(0.75, 0.95)));
  }
  paintSkirting(canvas);
}

void paintBricks(const Canvas& canvas, const cv::Scalar& color) {
  constexpr double length = 0.24, course = 0.08, joint = 0.012;
  canvas.fill({185, 190, 195});
  canvas.mottle(0.08, 0.02, 0.02);
  Random& random = canvas.random();
  for (int row = 0; row * course < canvas.height(); ++row)
    for (double x = row % 2 ? -length / 2 : 0; x < canvas.width(); x += length) {
      const Canvas brick = canvas.part(x, row * course, length - joint, course - joint);
      brick.fill(varied(color, 0.22, random));
      brick.mottle(0.12, 0.04, 0.03);
    }
  paintSkirting(canvas);
}

void paintWallpaper(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.03, 0.4, 0.4);
  Random& random = canvas.random();
  const cv::Scalar petals[] = {randomColor(random), randomColor(random), randomColor(random)};
  for (double y = 0.2; y < canvas.height(); y += 0.22)
    for (double x = 0.1; x < canvas.width(); x += 0.28)
      if (random.uniform() < 0.75)
        paintFlower(canvas, x + random.uniform(-0.1, 0.1), y + random.uniform(-0.08, 0.08), petals[random.below(3)]);
  paintSkirting(canvas);
}

}  // namespace vmcl
