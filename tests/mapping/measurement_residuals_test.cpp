// SPDX-License-Identifier: BSD-3-Clause
#include "measurement_residuals.h"

#include <gtest/gtest.h>

#include "synthetic_room.h"

namespace vmcl {
namespace {

/// A keyframe of a distorted camera, everything off by something.
Reconstruction oneView(Random& random) {
  const auto some = [&](double sigma) {
    return Eigen::Vector3d(sigma * Eigen::Vector3d::NullaryExpr([&] { return random.normal(); }));
  };
  Reconstruction scene;
  scene.cameras = {testing::forwardCamera()};
  scene.cameras[0].calibration.distortion = {-0.2, 0.05, 0.01, -0.02, 0.03};
  scene.corrections = {{some(0.1), some(0.1), some(0.05)}};
  scene.keyframes.resize(1);
  scene.keyframes[0].features.pixels.emplace_back(200, 300);
  scene.map_from_robot = {{random.normal(), random.normal(), random.uniform(-3, 3)}};
  scene.stance = {some(0.1)};
  scene.depths = {{2.5f}};
  scene.level_from_robot = {Rigid3(Eigen::Translation3d(some(0.2))) * Eigen::AngleAxisd(0.3, some(1).normalized())};
  return scene;
}

/// What the measurements of the view's feature say of a point.
class MeasurementResiduals : public ::testing::Test {
 protected:
  Random random_{1};
  const Reconstruction scene_ = oneView(random_);
  const MeasuringCamera from_{&scene_.cameras[0], &scene_.level_from_robot[0]};
  const PixelMeasurement pixel_{from_, scene_.distortedPixel({0, 0}), 0.7};
  const DepthMeasurement depth_{from_, 2.5, 0.01};
  const Stand stand_ = standOf(scene_, 0);
  const CorrectionVector correction_ = correctionVector(scene_.corrections[0]);

  Eigen::Vector3d pointInMap(const Eigen::Vector3d& point_in_camera) const {
    return scene_.view(0).map_from_camera * point_in_camera;
  }

  template <typename Measurement>
  void expectNumericDerivatives(const Measurement& measurement, const Eigen::Vector3d& point_in_camera) const {
    Eigen::Vector<double, 18> values;
    values << stand_, correction_, pointInMap(point_in_camera);
    const auto linearizedAt = [&](const Eigen::Vector<double, 18>& at) {
      return measurement.linearize(at.head<6>(), at.segment<9>(6), at.tail<3>());
    };
    const auto analytic = linearizedAt(values);
    Eigen::Matrix<double, Measurement::rows, 18> by_values;
    by_values << analytic.by_stand, analytic.by_correction, analytic.by_point;
    constexpr double step = 1e-6;
    for (Eigen::Index i = 0; i < 18; ++i) {
      const Eigen::Vector<double, 18> moved = step * Eigen::Vector<double, 18>::Unit(i);
      const auto numeric =
          ((linearizedAt(values + moved).error - linearizedAt(values - moved).error) / (2 * step)).eval();
      EXPECT_LT((numeric - by_values.col(i)).norm(), 1e-5 * (1 + by_values.norm())) << "value " << i;
    }
  }
};

TEST_F(MeasurementResiduals, AreThoseOfTheReconstruction) {
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0.4, -0.3, 2), Eigen::Vector3d(-1, 0.8, 1.5)}) {
    const CameraCalibration lens = scene_.calibration(0);
    const Eigen::Vector2d seen = lens.distort(lens.pinhole.project(point));
    const Eigen::Vector2d error = pixel_.linearize(stand_, correction_, pointInMap(point)).error;
    EXPECT_LT((error - (seen - scene_.distortedPixel({0, 0})) / 0.7).norm(), 1e-9);
    EXPECT_NEAR(depth_.linearize(stand_, correction_, pointInMap(point)).error[0], (1 / point.z() - 1 / 2.5) / 0.01,
                1e-9);
  }
}

TEST_F(MeasurementResiduals, HaveTheirDerivatives) {
  const Eigen::Vector3d points[] = {{0.4, -0.3, 2}, {-1, 0.8, 1.5}, {5, 1, 2}, {0.4, -0.3, -1}};  // far aside; behind
  for (const Eigen::Vector3d& point : points) {
    expectNumericDerivatives(pixel_, point);
    expectNumericDerivatives(depth_, point);
  }
}

}  // namespace
}  // namespace vmcl
