// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "materials.h"

namespace vmcl {

void paintCloth(const Canvas& canvas, const cv::Scalar& color) {
  canvas.fill(color);
  canvas.mottle(0.14, 0.06, 0.2);
  canvas.mottle(0.07, 0.01, 0.01);
}

void paintRug(const Canvas& canvas, const cv::Scalar& color) {
  Random& random = canvas.random();
  const cv::Scalar border = shaded(color, 0.5), ground = varied(color, 0.1, random), accent = randomColor(random);
  const double wide = canvas.width(), high = canvas.height(), edge = 0.1 * std::min(wide, high);
  canvas.fill(border);
  canvas.part(edge * 0.4, edge * 0.4, wide - 0.8 * edge, high - 0.8 * edge).fill(accent);
  const Canvas field = canvas.part(edge * 0.6, edge * 0.6, wide - 1.2 * edge, high - 1.2 * edge);
  field.fill(ground);
  const double motif = std::max(0.12, 0.16 * std::min(wide, high));
  for (double y = 0; y < field.height(); y += motif)
    for (double x = 0; x < field.width(); x += motif) {
      const double cx = x + motif / 2, cy = y + motif / 2, r = motif * random.uniform(0.25, 0.45);
      field.polygon({{cx - r, cy}, {cx, cy + r}, {cx + r, cy}, {cx, cy - r}},
                    random.uniform() < 0.5 ? accent : varied(border, 0.5, random));
    }
  canvas.mottle(0.1, 0.02, 0.02);
}

void paintCurtain(const Canvas& canvas, const cv::Scalar& color) {
  Random& random = canvas.random();
  canvas.fill(color);
  for (double x = 0; x < canvas.width();) {
    const double fold = random.uniform(0.05, 0.12);
    canvas.rectangle(x, 0, fold * 0.3, canvas.height(), shaded(color, 0.72));
    canvas.rectangle(x + fold * 0.3, 0, fold * 0.2, canvas.height(), shaded(color, 0.88));
    canvas.rectangle(x + fold * 0.7, 0, fold * 0.2, canvas.height(), shaded(color, 1.08));
    x += fold;
  }
  canvas.mottle(0.04, 0.02, 0.3);
}

void paintLeaves(const Canvas& canvas, const cv::Scalar& color) {
  Random& random = canvas.random();
  canvas.fill(shaded(color, 0.35));
  const int leaves = static_cast<int>(std::clamp(canvas.width() * canvas.height() * 1500, 30.0, 1500.0));
  for (int i = 0; i < leaves; ++i) {
    const double x = random.uniform(0, canvas.width()), y = random.uniform(0, canvas.height());
    canvas.ellipse(x, y, random.uniform(0.02, 0.05), random.uniform(0.008, 0.018), random.uniform(0, 180),
                   varied(color, 0.5, random));
  }
}

void paintMarble(const Canvas& canvas, const cv::Scalar& color) {
  Random& random = canvas.random();
  canvas.fill(color);
  canvas.mottle(0.06, 0.3, 0.3);
  for (int i = 0; i < 14; ++i) {
    double x = random.uniform(0, canvas.width()), y = random.uniform(0, canvas.height());
    for (int step = 0; step < 10; ++step) {
      const double dx = random.uniform(-0.02, 0.1), dy = random.uniform(-0.06, 0.06);
      canvas.line(x, y, x + dx, y + dy, 0.003, shaded(color, random.uniform(0.65, 0.9)));
      x += dx;
      y += dy;
    }
  }
}

void paintMetal(const Canvas& canvas, const cv::Scalar& color) {
  canvas.gradient(shaded(color, 0.8), shaded(color, 1.1));
  canvas.mottle(0.05, 0.5, 0.004);
}

void paintScreen(const Canvas& canvas, const cv::Scalar& color) {
  Random& random = canvas.random();
  canvas.fill({22, 20, 20});
  const double rim = 0.03 * std::min(canvas.width(), canvas.height());
  const Canvas picture = canvas.part(rim, rim, canvas.width() - 2 * rim, canvas.height() - 2 * rim);
  picture.gradient(shaded(color, 0.35), color);
  for (int i = 0; i < 7; ++i)
    picture.rectangle(random.uniform(0, 0.8) * picture.width(), random.uniform(0, 0.8) * picture.height(),
                      random.uniform(0.1, 0.4) * picture.width(), random.uniform(0.03, 0.2) * picture.height(),
                      varied(randomColor(random), 0.2, random));
}

void paintPaper(const Canvas& canvas, const cv::Scalar& color) {
  Random& random = canvas.random();
  canvas.fill(color);
  for (double y = 0.012; y < canvas.height() - 0.01; y += 0.012)
    canvas.line(0.015, y, canvas.width() * random.uniform(0.5, 0.93), y, 0.003, {90, 80, 80});
}

}  // namespace vmcl
