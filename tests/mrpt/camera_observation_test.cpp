// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/camera_observation.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

namespace vmcl {
namespace {

using mrpt::img::CImage;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationImage;
constexpr double right_angle = std::numbers::pi / 2;

/// 8x6, left half black, right half white.
CImage halves() {
  CImage image(8, 6, mrpt::img::CH_RGB);
  image.filledRectangle(0, 0, 3, 5, mrpt::img::TColor(0, 0, 0));
  image.filledRectangle(4, 0, 7, 5, mrpt::img::TColor(255, 255, 255));
  return image;
}

mrpt::img::TCamera camera8x6() {
  mrpt::img::TCamera camera;
  camera.ncols = 8;
  camera.nrows = 6;
  camera.setIntrinsicParamsFromValues(10, 11, 3.5, 2.5);
  return camera;
}

CObservationImage observation8x6() {
  CObservationImage observation;
  observation.sensorLabel = "front";
  observation.timestamp = mrpt::Clock::fromDouble(1234.5);
  observation.image = halves();
  observation.cameraParams = camera8x6();
  observation.cameraPose = mrpt::poses::CPose3D(0.1, 0.2, 0.3, -right_angle, 0, -right_angle);
  return observation;
}

std::string failureOf(const mrpt::obs::CObservation& observation) {
  try {
    cameraObservation(observation);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no failure";
}

TEST(CameraObservation, readsImageCalibrationMountAndTime) {
  CObservationImage observation = observation8x6();
  observation.cameraParams.setDistortionPlumbBob(0.1, 0.2, 0.3, 0.4, 0.5);
  const auto camera = cameraObservation(observation);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->label, "front");
  EXPECT_NEAR(camera->time, 1234.5, 1e-6);
  EXPECT_EQ(camera->calibration.pinhole.width, 8);
  EXPECT_EQ(camera->calibration.pinhole.height, 6);
  EXPECT_EQ(camera->calibration.pinhole.fy, 11);
  EXPECT_EQ(camera->calibration.pinhole.cx, 3.5);
  EXPECT_EQ(camera->calibration.distortion, (std::array<double, 5>{0.1, 0.2, 0.3, 0.4, 0.5}));
  ASSERT_EQ(camera->image.pixels.size(), 48u);
  EXPECT_EQ(camera->image.pixels[8 + 3], 0);
  EXPECT_EQ(camera->image.pixels[8 + 4], 255);
}

TEST(CameraObservation, refusesAnImageWithoutATimeStamp) {
  CObservationImage observation = observation8x6();
  observation.timestamp = INVALID_TIMESTAMP;
  EXPECT_EQ(failureOf(observation), "camera 'front': no time stamp");
}

TEST(CameraObservation, looksForwardWithMrptsAngles) {
  const auto camera = cameraObservation(observation8x6());
  ASSERT_TRUE(camera);
  const Eigen::Vector3d ahead = camera->robot_from_camera * Eigen::Vector3d(0, 0, 1);
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(1.1, 0.2, 0.3), 1e-9)) << ahead.transpose();
  const Eigen::Vector3d right = camera->robot_from_camera.linear() * Eigen::Vector3d(1, 0, 0);
  EXPECT_TRUE(right.isApprox(Eigen::Vector3d(0, -1, 0), 1e-9)) << right.transpose();
}

TEST(CameraObservation, readsTheIntensityImageOfADepthCamera) {
  CObservation3DRangeScan observation;
  observation.sensorLabel = "rgbd";
  observation.hasIntensityImage = true;
  observation.intensityImage = halves();
  observation.cameraParamsIntensity = camera8x6();
  observation.sensorPose = mrpt::poses::CPose3D(0, 0, 0.5, 0, 0, 0);
  const auto camera = cameraObservation(observation);
  ASSERT_TRUE(camera);
  const Eigen::Vector3d ahead = camera->robot_from_camera * Eigen::Vector3d(0, 0, 1);
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(1, 0, 0.5), 1e-9)) << ahead.transpose();
  EXPECT_EQ(camera->image.pixels[7], 255);
}

TEST(CameraObservation, readsTheLeftImageOfAStereoCamera) {
  mrpt::obs::CObservationStereoImages observation;
  observation.timestamp = mrpt::Clock::fromDouble(1234.5);
  observation.imageLeft = halves();
  observation.leftCamera = camera8x6();
  observation.cameraPose = mrpt::poses::CPose3DQuat(observation8x6().cameraPose);
  const auto camera = cameraObservation(observation), left = cameraObservation(observation8x6());
  ASSERT_TRUE(camera);
  EXPECT_TRUE(sameCalibration(camera->calibration, left->calibration));
  EXPECT_EQ(camera->image.pixels, left->image.pixels);
  EXPECT_TRUE(camera->robot_from_camera.isApprox(left->robot_from_camera, 1e-9));
}

TEST(CameraObservation, readsAnImageKeptOutsideAndLeavesTheObservationUnloaded) {
  const auto file = std::filesystem::temp_directory_path() / ("halves" + std::to_string(getpid()) + ".png");
  ASSERT_TRUE(halves().saveToFile(file));
  CObservationImage observation = observation8x6();
  observation.image.setExternalStorage(file);
  const auto camera = cameraObservation(observation);
  std::filesystem::remove(file);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->image.pixels, cameraObservation(observation8x6())->image.pixels);
  EXPECT_NE(failureOf(observation).find(file.string()), std::string::npos) << failureOf(observation);
}

TEST(CameraObservation, otherClassesAreNotCameras) {
  EXPECT_FALSE(cameraObservation(mrpt::obs::CObservation2DRangeScan()));
}

TEST(CameraObservation, namesTheSensorAndWhatIsWrong) {
  const auto expectFailure = [](const mrpt::obs::CObservation& observation, const std::string& reason) {
    const std::string failure = failureOf(observation);
    EXPECT_NE(failure.find(reason), std::string::npos) << failure;
    EXPECT_EQ(failure.find(observation.sensorLabel.empty() ? "camera ''" : "camera 'front'"), 0u) << failure;
  };
  CObservationImage observation = observation8x6();
  observation.image = CImage();
  expectFailure(observation, "no image");
  observation = observation8x6();
  observation.cameraParams = mrpt::img::TCamera();
  expectFailure(observation, "no intrinsics");
  observation = observation8x6();
  observation.cameraParams.ncols = 9;
  expectFailure(observation, "8x6");
  observation = observation8x6();
  observation.cameraParams.fx(std::numeric_limits<double>::quiet_NaN());
  expectFailure(observation, "fx");
  observation = observation8x6();
  observation.cameraPose.x(std::numeric_limits<double>::infinity());
  expectFailure(observation, "not finite");
  observation = observation8x6();
  observation.cameraParams.distortion = mrpt::img::DistortionModel::kannala_brandt;
  expectFailure(observation, "lens model");
  expectFailure(CObservation3DRangeScan(), "no image");
}

}  // namespace
}  // namespace vmcl
