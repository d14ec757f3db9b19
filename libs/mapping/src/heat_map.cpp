// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/heat_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vmcl {
namespace {

constexpr double full_depth = 10;   // m
constexpr double full_sigma = 0.5;  // m
constexpr double full_observations = 20;
constexpr double most_landmarks = 8;  // of full height, that one place can show
constexpr double spread = 1.0 / 32;   // of a landmark, over the image's width
constexpr double reach = 3;           // in deviations

/// What a Gaussian about `center` comes to at the pixels from `first` on.
std::vector<float> profile(double center, double sigma, int size, int& first) {
  first = std::max(0, static_cast<int>(std::ceil(center - reach * sigma)));
  const int last = std::min(size - 1, static_cast<int>(std::floor(center + reach * sigma)));
  std::vector<float> values;
  for (int i = first; i <= last; ++i)
    values.push_back(static_cast<float>(std::exp(-0.5 * std::pow((i - center) / sigma, 2))));
  return values;
}

class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width),
        height_(height),
        values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Eigen::Vector3f::Zero()) {}

  void add(const Eigen::Vector2d& center, const Eigen::Vector2d& sigma, const Eigen::Vector3f& height) {
    int left = 0, top = 0;
    const std::vector<float> columns = profile(center.x(), sigma.x(), width_, left);
    const std::vector<float> rows = profile(center.y(), sigma.y(), height_, top);
    if (columns.empty()) return;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      Eigen::Vector3f* const line = &values_[(static_cast<std::size_t>(top) + row) * static_cast<std::size_t>(width_) +
                                             static_cast<std::size_t>(left)];
      for (std::size_t column = 0; column < columns.size(); ++column)
        line[column] += rows[row] * columns[column] * height;
    }
  }

  ColourImage image() const {
    ColourImage image{width_, height_, {}};
    image.pixels.reserve(3 * values_.size());
    for (const Eigen::Vector3f& value : values_)
      for (int channel = 0; channel < 3; ++channel)
        image.pixels.push_back(
            static_cast<uint8_t>(std::lround(std::min(255.0, 255 / most_landmarks * double{value[channel]}))));
    return image;
  }

 private:
  int width_, height_;
  std::vector<Eigen::Vector3f> values_;
};

constexpr int max_side = 4096;

}  // namespace

ColourImage heatMap(const KeyframeMap& map, const Keyframe& keyframe, int width, int height) {
  if (width < 1 || height < 1 || width > max_side || height > max_side)
    throw std::invalid_argument("a heat map of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
  const ReferenceCamera camera = map.referenceCamera(keyframe);
  const Eigen::Array2d scale(double(width) / camera.camera.width, double(height) / camera.camera.height);
  const Eigen::Vector2d sigma = spread * camera.camera.width * scale;
  const Rigid3 camera_from_map = camera.map_from_camera.inverse();
  Canvas canvas(width, height);
  for (std::size_t i = 0; i < keyframe.landmark_of_feature.size(); ++i) {
    if (keyframe.landmark_of_feature[i] < 0) continue;
    const Landmark& landmark = map.landmarks[static_cast<std::size_t>(keyframe.landmark_of_feature[i])];
    const Eigen::Vector3d point = camera_from_map * landmark.point_in_map;
    if (!(point.z() > 0)) continue;
    const Eigen::Vector3d ray = camera.map_from_camera.linear() * point.normalized();
    const double sigma_along = std::sqrt(std::max(0.0, ray.dot(landmark.covariance * ray)));
    const auto share = [](double value, double full) { return static_cast<float>(std::min(1.0, value / full)); };
    const Eigen::Vector2d pixel = keyframe.features.pixels[i].cast<double>();
    if (!camera.camera.contains(pixel)) continue;
    canvas.add((pixel.array() + 0.5) * scale - 0.5, sigma,
               {share(landmark.observation_count, full_observations), share(sigma_along, full_sigma),
                share(point.z(), full_depth)});
  }
  return canvas.image();
}

}  // namespace vmcl
