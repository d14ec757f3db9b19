// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/stereo_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

/// The plane n . X = 1 in the left optical frame, painted with a smooth random pattern.
class PaintedPlane {
 public:
  PaintedPlane() {
    Random random(1);
    for (Wave& wave : waves_) wave = {{30 * random.normal(), 30 * random.normal()}, random.uniform(0, 6.3)};
  }

  double depthAt(const Eigen::Vector3d& ray) const { return 1 / normal_.dot(ray); }

  /// Seen by a camera at left_from_camera.
  Image seenBy(const CameraCalibration& camera, const Rigid3& left_from_camera) const {
    const PinholeCamera& pinhole = camera.pinhole;
    Image image{pinhole.width, pinhole.height, {}};
    for (int v = 0; v < pinhole.height; ++v)
      for (int u = 0; u < pinhole.width; ++u) {
        const Eigen::Vector3d center = left_from_camera.translation();
        const Eigen::Vector3d ray = left_from_camera.linear() * pinhole.ray(camera.undistort(Eigen::Vector2d(u, v)));
        const double way = (1 - normal_.dot(center)) / normal_.dot(ray);
        image.pixels.push_back(brightness(center + way * ray));
      }
    return image;
  }

 private:
  struct Wave {
    Eigen::Vector2d frequency;
    double phase;
  };

  uint8_t brightness(const Eigen::Vector3d& point) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.frequency.dot(point.head<2>()) + wave.phase);
    return static_cast<uint8_t>(std::clamp(128 + 20 * sum, 0.0, 255.0));
  }

  const Eigen::Vector3d normal_{0.1, 0.05, 0.5};
  Wave waves_[20];
};

StereoPair rectifiedPair() {
  const CameraCalibration camera{{320, 240, 250, 250, 159.5, 119.5}, {}};
  return {camera, camera, Rigid3(Eigen::Translation3d(0.1, 0, 0))};
}

/// Median error of disparities (px) and share of the pixels that have one.
std::pair<double, double> errorAndShare(const StereoPair& pair) {
  const PaintedPlane plane;
  const DepthImage depth =
      stereoDepth(pair, plane.seenBy(pair.left, Rigid3::Identity()), plane.seenBy(pair.right, pair.left_from_right));
  const PinholeCamera& pinhole = pair.left.pinhole;
  const double scale = pinhole.fx * pair.left_from_right.translation().norm();
  std::vector<double> errors;
  for (int v = 0; v < pinhole.height; ++v)
    for (int u = 0; u < pinhole.width; ++u) {
      const double measured = double{depth.depths[static_cast<std::size_t>(v * depth.width + u)]};
      const double truth = plane.depthAt(pinhole.ray(pair.left.undistort(Eigen::Vector2d(u, v))));
      if (measured > 0) errors.push_back(std::abs(scale / measured - scale / truth));
    }
  std::ranges::sort(errors);
  return {errors.at(errors.size() / 2), static_cast<double>(errors.size()) / static_cast<double>(depth.depths.size())};
}

TEST(StereoDepth, MeasuresASlantedPlane) {
  const auto [error, share] = errorAndShare(rectifiedPair());
  EXPECT_LT(error, 0.15);
  EXPECT_GT(share, 0.8);
}

TEST(StereoDepth, RectifiesCamerasThatAreNot) {
  StereoPair pair = rectifiedPair();
  pair.left.distortion = {-0.2, 0.03, 0.001, -0.002, 0};
  pair.right.pinhole.fx = pair.right.pinhole.fy = 270;
  pair.right.pinhole.cx = 150;
  pair.left_from_right =
      Eigen::Translation3d(0.1, 0.01, -0.005) * Eigen::AngleAxisd(0.05, Eigen::Vector3d(1, 2, 0.5).normalized());
  const auto [error, share] = errorAndShare(pair);
  EXPECT_LT(error, 0.2);
  EXPECT_GT(share, 0.7);
}

TEST(StereoDepth, KnowsNothingWithoutAPattern) {
  const Image blank{320, 240, std::vector<uint8_t>(320 * 240, 90)};
  const DepthImage depth = stereoDepth(rectifiedPair(), blank, blank);
  EXPECT_EQ(depth.width, 320);
  EXPECT_EQ(std::ranges::count(depth.depths, 0.0F), 320 * 240);
}

TEST(StereoDepth, RefusesWhatIsNoPair) {
  const Image image{320, 240, std::vector<uint8_t>(320 * 240)};
  const auto refuses = [&](const auto& spoil) {
    StereoPair pair = rectifiedPair();
    spoil(pair);
    EXPECT_THROW(stereoDepth(pair, image, image), std::invalid_argument);
  };
  refuses([](StereoPair& pair) { pair.left_from_right.translation().setZero(); });
  refuses([](StereoPair& pair) { pair.left_from_right.translation() *= -1; });
  refuses([](StereoPair& pair) { pair.left_from_right.translation() = Eigen::Vector3d(0, 0.1, 0); });
  refuses([](StereoPair& pair) { pair.left_from_right.translation().x() = std::nan(""); });
  refuses([](StereoPair& pair) {
    pair.left_from_right.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
  });
  refuses([](StereoPair& pair) { pair.right.pinhole.fx = 0; });
  refuses([](StereoPair& pair) { pair.right.pinhole.width = 300; });
}

}  // namespace
}  // namespace vmcl
