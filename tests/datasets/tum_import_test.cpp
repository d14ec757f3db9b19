// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/tum_import.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "scratch_directory.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/datasets/rawlog_writer.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/mrpt/measured_depth.h"

namespace vmcl {
namespace {

/// A data set of five images of grey 0, 10, ..., 40 at 100, 101, ... seconds, poses at every quarter of a second.
class TumImportTest : public testing::Test {
 protected:
  TumImportTest() {
    std::filesystem::create_directories(data() / "rgb");
    std::string list = "# timestamp filename\n", poses = "# timestamp tx ty tz qx qy qz qw\n";
    for (int i = 0; i < 5; ++i) {
      const std::string name = "rgb/" + std::to_string(i) + ".png";
      cv::imwrite((data() / name).string(), cv::Mat(24, 32, CV_8U, cv::Scalar(10 * i)));
      list += std::to_string(100 + i) + ".0 " + name + "\n";
    }
    for (int i = 0; i < 40; ++i)
      poses += std::to_string(97 + 0.25 * i) + " " + std::to_string(0.1 * i) + " 2 0 0 0 0.7071068 0.7071068\n";
    write("rgb.txt", list);
    write("odometry.txt", poses);
    write("groundtruth.txt", poses);
    write("calibration.yaml",
          "camera: {width: 32, height: 24, fx: 30, fy: 31, cx: 16, cy: 12, distortion: [0.1, 0, 0, 0, 0]}\n"
          "robot_from_camera: {x: 0.1, y: 0, z: 0.3, yaw_deg: 90, pitch_deg: 0, roll_deg: 0}\n"
          "mask_rows_from_top: 5\n");
  }

  std::filesystem::path data() const { return scratch_.path() / "data"; }
  std::filesystem::path log() const { return scratch_.path() / "out.rawlog"; }

  void write(const std::string& name, const std::string& text) const { std::ofstream(data() / name) << text; }
  void append(const std::string& name, const std::string& text) const {
    std::ofstream(data() / name, std::ios::app) << text;
  }

  std::string failure(const TumImportOptions& options = {}) const {
    try {
      importTum(data(), log(), options);
    } catch (const std::exception& error) {
      EXPECT_FALSE(std::filesystem::exists(log()));
      return error.what();
    }
    return "no failure";
  }

  ScratchDirectory scratch_;
};

TEST_F(TumImportTest, writesImagesAndOdometryByTime) {
  const auto report = importTum(data(), log());
  EXPECT_EQ(report.images, 5);
  EXPECT_EQ(report.mask_rows_from_top, 5);
  EXPECT_TRUE(report.problems.empty());
  RawlogReader reader(log());
  RawlogEntry entry;
  double last_time = 0;
  int images = 0, readings = 0;
  while (reader.next(entry)) {
    const double time = mrpt::Clock::toDouble(entry.observation->timestamp);
    EXPECT_GE(time, last_time);
    last_time = time;
    if (const auto camera = cameraObservation(*entry.observation)) {
      EXPECT_EQ(camera->image.pixels.front(), 10 * images);
      EXPECT_NEAR(camera->time, 100 + images, 1e-6);
      ++images;
    } else {
      const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(entry.observation);
      ASSERT_TRUE(odometry);
      EXPECT_NEAR(odometry->odometry.x(), 0.1 * (time - 97) / 0.25, 1e-5);
      EXPECT_NEAR(odometry->odometry.phi(), std::numbers::pi / 2, 1e-6);
      ++readings;
    }
  }
  EXPECT_EQ(images, 5);
  EXPECT_EQ(readings, 25);  // from a second before the first image to a second after the last
  EXPECT_EQ(report.odometry_readings, 25);
  EXPECT_EQ(readTumTrajectory(scratch_.path() / "out.groundtruth.tum").poses().size(), 25u);
}

TEST_F(TumImportTest, placesTheCameraAsCalibrated) {
  importTum(data(), log());
  RawlogReader reader(log());
  RawlogEntry entry;
  std::optional<CameraObservation> camera;
  while (!camera && reader.next(entry)) camera = cameraObservation(*entry.observation);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->calibration.pinhole.fy, 31);
  EXPECT_EQ(camera->calibration.distortion[0], 0.1);
  const Eigen::Vector3d ahead = camera->robot_from_camera * Eigen::Vector3d(0, 0, 1);  // mounted facing left
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(0.1, 1, 0.3), 1e-9)) << ahead.transpose();
}

TEST_F(TumImportTest, cutsByLinesOfTheImageList) {
  EXPECT_EQ(failure({.first_frame = 3, .last_frame = 2}), "last_frame 2 is before first_frame 3");
  const auto report = importTum(data(), log(), {.first_frame = 1, .last_frame = 2});
  EXPECT_EQ(report.images, 2);
  EXPECT_EQ(report.odometry_readings, 13);  // 100 s to 103 s
}

TEST_F(TumImportTest, leavesOutBadImagesAndNamesThem) {
  append("rgb.txt", "nonsense\nnan rgb/0.png\n105 rgb/missing.png\n106 ../secret.png\n107 rgb/broken.png\n");
  write("rgb/broken.png", "no image");
  cv::imwrite((data() / "rgb/large.png").string(), cv::Mat(48, 64, CV_8U, cv::Scalar(0)));
  append("rgb.txt", "108 rgb/large.png\n");
  const auto report = importTum(data(), log());
  EXPECT_EQ(report.images, 5);
  ASSERT_EQ(report.problems.size(), 6u);
  for (const std::string& problem : report.problems) EXPECT_NE(problem.find("rgb.txt:"), std::string::npos) << problem;
  EXPECT_NE(report.problems[0].find("rgb.txt:7: expected"), std::string::npos) << report.problems[0];
  EXPECT_NE(report.problems[1].find("rgb.txt:8: expected"), std::string::npos) << report.problems[1];
}

TEST_F(TumImportTest, joinsDepthToTheImageOfItsTime) {
  std::filesystem::create_directories(data() / "depth");
  cv::imwrite((data() / "depth/good.png").string(), cv::Mat(24, 32, CV_16U, cv::Scalar(7500)));
  cv::imwrite((data() / "depth/grey.png").string(), cv::Mat(24, 32, CV_8U, cv::Scalar(75)));
  cv::imwrite((data() / "depth/small.png").string(), cv::Mat(12, 32, CV_16U, cv::Scalar(7500)));
  write("depth.txt",
        "# depth maps\n100.03 depth/good.png\n101.015 depth/good.png\n102 depth/grey.png\n"
        "103 depth/small.png\n104 depth/missing.png\n");
  const auto report = importTum(data(), log());
  EXPECT_EQ(report.images, 5);
  EXPECT_EQ(report.depth_images, 1);
  ASSERT_EQ(report.problems.size(), 3u);
  for (int i = 0; i < 3; ++i)
    EXPECT_NE(report.problems[static_cast<std::size_t>(i)].find("depth.txt:" + std::to_string(4 + i)),
              std::string::npos);
  RawlogReader reader(log());
  RawlogEntry entry;
  std::vector<CameraObservation> cameras;
  std::vector<DepthImage> depths;
  while (reader.next(entry))
    if (const auto camera = cameraObservation(*entry.observation)) {
      cameras.push_back(*camera);
      depths.push_back(measuredDepth(*entry.observation, rawlogCompanion(log(), "_Images")));
    }
  ASSERT_EQ(cameras.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(depths[i].empty(), i != 1);
  EXPECT_FLOAT_EQ(depthAt(depths[1], {16, 12}), 1.5f);
  EXPECT_EQ(cameras[1].image.pixels.front(), 10);
  const Eigen::Vector3d ahead = cameras[1].robot_from_camera * Eigen::Vector3d(0, 0, 1);
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(0.1, 1, 0.3), 1e-6)) << ahead.transpose();
}

TEST_F(TumImportTest, namesMissingAndBrokenFiles) {
  append("odometry.txt", "120 nan 0 0 0 0 0 1\n");
  EXPECT_NE(failure().find("odometry.txt:42"), std::string::npos) << failure();
  write("calibration.yaml", "camera: {width: 32}\n");
  EXPECT_NE(failure().find("calibration.yaml:1: camera.height is missing"), std::string::npos) << failure();
  std::filesystem::remove(data() / "calibration.yaml");
  EXPECT_NE(failure().find("calibration.yaml: cannot be opened"), std::string::npos) << failure();
}

TEST_F(TumImportTest, refusesWhenNoImageIsLeft) {
  write("rgb.txt", "# none\n");
  EXPECT_NE(failure().find("no image to import"), std::string::npos) << failure();
  write("rgb.txt", "100 rgb/missing.png\n");
  EXPECT_NE(failure().find("rgb.txt:1"), std::string::npos) << failure();
  std::filesystem::remove(data() / "rgb.txt");
  EXPECT_NE(failure().find("rgb.txt: cannot be opened"), std::string::npos) << failure();
}

TEST_F(TumImportTest, poseFilesMayBeMissing) {
  std::filesystem::remove(data() / "odometry.txt");
  std::filesystem::remove(data() / "groundtruth.txt");
  const auto report = importTum(data(), log());
  EXPECT_EQ(report.odometry_readings, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "out.groundtruth.tum"));
}

}  // namespace
}  // namespace vmcl
