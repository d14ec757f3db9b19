// SPDX-License-Identifier: BSD-3-Clause
#include "surface_painter.h"

#include <algorithm>
#include <cmath>

#include "decorations.h"
#include "materials.h"

namespace vmcl {
namespace {

/// How bright a side of this direction looks.
double shade(const Eigen::Vector3d& normal, const Light& light) {
  if (normal.z() > 0.5) return light.brightness;
  if (normal.z() < -0.5) return 0.95 * light.brightness;
  const double towards_light =
      normal.x() * std::cos(light.daylight_azimuth) + normal.y() * std::sin(light.daylight_azimuth);
  return (0.84 + 0.14 * towards_light) * light.brightness;
}

/// Edges of a room are darker than the middle of its walls.
double cornerShade(double distance) { return 1 - 0.22 * std::exp(-distance / 0.15); }

}  // namespace

cv::Mat paintSurface(const Surface& surface, uint64_t seed, uint64_t number) {
  Random random(seed, number);
  const double scale = surface.pixels_per_metre;
  cv::Mat image(std::max(1, static_cast<int>(std::lround(surface.height * scale))),
                std::max(1, static_cast<int>(std::lround(surface.width * scale))), CV_8UC3);
  const Canvas canvas(image, scale, random);
  const auto [red, green, blue] = surface.material.rgb;
  paintMaterial(surface.material.name, canvas, cv::Scalar(blue, green, red));
  for (const Decoration& decoration : surface.decorations) {
    const Eigen::Vector2d corner = decoration.center - decoration.size / 2;
    paintDecoration(decoration.kind, canvas.part(corner.x(), corner.y(), decoration.size.x(), decoration.size.y()));
  }
  return image;
}

void shadeEvenly(cv::Mat& image, const Surface& surface, const Light& light) {
  const double base = shade(surface.normal, light), scale = surface.pixels_per_metre;
  std::vector<double> column_factor;
  for (int x = 0; x < image.cols; ++x)
    column_factor.push_back(cornerShade((std::min(x, image.cols - 1 - x) + 0.5) / scale));
  for (int y = 0; y < image.rows; ++y) {
    const double row_factor = base * cornerShade((std::min(y, image.rows - 1 - y) + 0.5) / scale);
    auto* pixels = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image.cols; ++x) pixels[x] = cv::Vec3b(cv::Vec3d(pixels[x]) * row_factor * column_factor[x]);
  }
}

}  // namespace vmcl
