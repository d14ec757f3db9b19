// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

const PinholeCamera camera{640, 480, 517.3, 516.5, 318.6, 255.3};

TEST(PinholeCamera, ProjectInvertsRay) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d pixel(random.uniform(0, 640), random.uniform(0, 480));
    EXPECT_TRUE(camera.project(camera.ray(pixel) * random.uniform(0.1, 10)).isApprox(pixel, 1e-12));
  }
}

TEST(PinholeCamera, PixelsReachHalfAPixelBeyondTheirCentres) {
  EXPECT_TRUE(camera.contains({-0.5, 479.4}));
  EXPECT_FALSE(camera.contains({-0.6, 0}));
  EXPECT_FALSE(camera.contains({639.5, 0}));
}

TEST(PinholeCamera, RefusesImpossibleCameras) {
  const auto broken = [](auto change) {
    PinholeCamera bad = camera;
    change(bad);
    return bad;
  };
  EXPECT_NO_THROW(camera.check());
  EXPECT_THROW(broken([](auto& c) { c.width = 0; }).check(), std::invalid_argument);
  EXPECT_THROW(broken([](auto& c) { c.height = 1 << 20; }).check(), std::invalid_argument);
  EXPECT_THROW(broken([](auto& c) { c.fx = -1; }).check(), std::invalid_argument);
  EXPECT_THROW(broken([](auto& c) { c.cy = NAN; }).check(), std::invalid_argument);
}

TEST(CameraCalibration, UndistortInvertsDistort) {
  // TUM freiburg1, a strong real distortion.
  const CameraCalibration calibration{camera, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
  for (int u = 20; u < 640; u += 50)
    for (int v = 20; v < 480; v += 50) {
      const Eigen::Vector2d ideal(u, v);
      EXPECT_LT((calibration.undistort(calibration.distort(ideal)) - ideal).norm(), 1e-6) << u << ' ' << v;
    }
  EXPECT_TRUE(calibration.isDistorted());
  EXPECT_EQ((CameraCalibration{camera, {}}.undistort({3, 4})), Eigen::Vector2d(3, 4));
  CameraCalibration bad = calibration;
  bad.distortion[2] = INFINITY;
  EXPECT_THROW(bad.check(), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
