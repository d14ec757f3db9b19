// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "materials.h"

// Views from windows, in metres of the backdrop: the horizon is at the height `horizon`. The colour is the daylight,
// white by day and black at night.

namespace vmcl {
namespace {

constexpr double horizon = 25;

double dayOf(const cv::Scalar& color) { return color[0] / 255; }

/// A colour by this daylight; what is left at night is bluish.
cv::Scalar lit(const cv::Scalar& color, double day) {
  const cv::Scalar night(0.2 * color[0] + 6, 0.12 * color[1] + 2, 0.1 * color[2]);
  return day * color + (1 - day) * night;
}

void paintSky(const Canvas& canvas, double day) {
  Random& random = canvas.random();
  canvas.part(0, horizon, canvas.width(), canvas.height() - horizon)
      .gradient(lit({242, 232, 220}, day), lit({226, 176, 120}, day));
  for (int i = 0; i < 60; ++i) {
    const double x = random.uniform(0, canvas.width()), y = random.uniform(horizon + 4, canvas.height());
    const double wide = random.uniform(3, 12);
    for (int puff = 0; puff < 6; ++puff)
      canvas.ellipse(x + random.uniform(-wide, wide), y + random.uniform(-0.6, 0.6), random.uniform(1.5, wide * 0.5),
                     random.uniform(0.4, 1.3), 0, lit(varied({250, 244, 240}, 0.03, random), day));
  }
}

void paintTree(const Canvas& canvas, double x, double foot, double tall, double day) {
  Random& random = canvas.random();
  canvas.line(x, foot, x, foot + 0.5 * tall, 0.06 * tall, lit({42, 58, 74}, day));
  for (int i = 0; i < 14; ++i)
    canvas.ellipse(x + random.uniform(-0.26, 0.26) * tall, foot + random.uniform(0.45, 0.95) * tall, 0.14 * tall,
                   0.12 * tall, 0, lit(varied({52, 104, 66}, 0.45, random), day));
}

void paintHouse(const Canvas& canvas, double x, double wide, double tall, double day) {
  Random& random = canvas.random();
  const cv::Scalar fronts[] = {{150, 170, 196}, {120, 140, 176}, {176, 186, 192}, {110, 122, 142}, {170, 150, 140}};
  const cv::Scalar front = varied(fronts[random.below(5)], 0.15, random);
  canvas.rectangle(x, 0, wide, tall, lit(front, day));
  canvas.rectangle(x, tall, wide, 0.6, lit(shaded(front, 0.55), day));
  if (random.uniform() < 0.5)
    canvas.rectangle(x + wide * random.uniform(0.1, 0.7), tall, 1, 2, lit(shaded(front, 0.7), day));
  const double storey = random.uniform(2.6, 3.2), bay = random.uniform(1.8, 2.8);
  for (double y = std::fmod(tall, storey); y + 1.8 < tall; y += storey)
    for (double at = x + 0.6; at + 1.3 < x + wide; at += bay) {
      const bool lamp = random.uniform() < 0.35;
      const cv::Scalar glass = lit(varied({120, 98, 84}, 0.3, random), day);
      const cv::Scalar glow = varied({120, 200, 245}, 0.12, random);
      canvas.rectangle(at, y + 0.7, 1.1, 1.5, lit({215, 218, 220}, day));
      canvas.rectangle(at + 0.1, y + 0.8, 0.9, 1.3, lamp ? day * glass + (1 - day) * glow : glass);
    }
}

}  // namespace

void paintCity(const Canvas& canvas, const cv::Scalar& color) {
  const double day = dayOf(color);
  Random& random = canvas.random();
  canvas.fill(lit({120, 124, 128}, day));
  paintSky(canvas, day);
  for (const double size : {26.0, 14.0}) {  // far and near rows
    for (double x = 0; x < canvas.width();) {
      const double wide = random.uniform(5, 14);
      paintHouse(canvas, x, wide, horizon + random.uniform(0.1, 1) * size, day);
      x += wide + (random.uniform() < 0.3 ? random.uniform(0, 5) : 0);
    }
  }
  for (double x = 0; x < canvas.width(); x += random.uniform(3, 16))
    paintTree(canvas, x, horizon - 15, random.uniform(12, 24), day);
}

void paintGarden(const Canvas& canvas, const cv::Scalar& color) {
  const double day = dayOf(color);
  Random& random = canvas.random();
  canvas.fill(lit({62, 122, 84}, day));
  canvas.mottle(0.12, 3, 1);
  paintSky(canvas, day);
  for (double x = 0; x < canvas.width(); x += random.uniform(6, 20))
    canvas.ellipse(x, horizon - 2, random.uniform(14, 30), random.uniform(5, 12), 0,
                   lit(varied({110, 140, 110}, 0.2, random), day));
  for (double x = 0; x < canvas.width(); x += random.uniform(1, 5))
    paintTree(canvas, x, horizon - random.uniform(2, 6), random.uniform(7, 24), day);
  for (double x = 0; x < canvas.width(); x += 0.35)  // a fence
    canvas.rectangle(x, horizon - 6, 0.26, 4.3, lit(varied({96, 128, 156}, 0.15, random), day));
}

}  // namespace vmcl
