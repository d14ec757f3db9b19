// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "vmcl/geometry/random.h"
#include "vmcl/vision/features.h"

namespace vmcl {

inline CameraCalibration centredCamera(int width, int height, double focal = 300) {
  CameraCalibration calibration;
  calibration.pinhole = {width, height, focal, focal, (width - 1) / 2.0, (height - 1) / 2.0};
  return calibration;
}

/// Random rectangles of random brightness on grey.
inline Image rectangleTexture(int width, int height, uint64_t seed, int rectangles = 150) {
  Image image{width, height, std::vector<uint8_t>(static_cast<std::size_t>(width * height), 128)};
  Random random(seed);
  for (int r = 0; r < rectangles; ++r) {
    const int left = static_cast<int>(random.below(static_cast<uint32_t>(width)));
    const int top = static_cast<int>(random.below(static_cast<uint32_t>(height)));
    const int right = std::min(width, left + 8 + static_cast<int>(random.below(30)));
    const int bottom = std::min(height, top + 8 + static_cast<int>(random.below(30)));
    const auto brightness = static_cast<uint8_t>(random.below(256));
    for (int v = top; v < bottom; ++v)
      std::fill(image.pixels.begin() + v * width + left, image.pixels.begin() + v * width + right, brightness);
  }
  return image;
}

/// The image seen by a camera that has moved: content moves right and down by whole pixels, edges repeat.
inline Image shifted(const Image& image, int right, int down) {
  Image result = image;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      result.pixels[static_cast<std::size_t>(v * image.width + u)] = image.pixels[static_cast<std::size_t>(
          std::clamp(v - down, 0, image.height - 1) * image.width + std::clamp(u - right, 0, image.width - 1))];
  return result;
}

/// Features at random places with random descriptor bytes.
inline FeatureSet randomFeatures(FeatureKind kind, int count, Random& random) {
  FeatureSet features;
  features.kind = kind;
  features.descriptors.resize(count, kind == FeatureKind::orb ? 32 : kind == FeatureKind::akaze ? 64 : 128);
  for (int i = 0; i < count; ++i) {
    features.pixels.emplace_back(static_cast<float>(random.uniform(0, 640)),
                                 static_cast<float>(random.uniform(0, 480)));
    features.sizes.push_back(31);
    features.responses.push_back(1);
    for (Eigen::Index j = 0; j < features.descriptors.cols(); ++j)
      features.descriptors(i, j) = static_cast<uint8_t>(random.below(256));
  }
  return features;
}

}  // namespace vmcl
