// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/image_folder_import.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "scratch_directory.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/mrpt/camera_observation.h"

namespace vmcl {
namespace {

class ImageFolderTest : public testing::Test {
 protected:
  ImageFolderTest() {
    std::filesystem::create_directory(folder());
    std::ofstream(folder() / "calibration.yaml")
        << "camera: {width: 32, height: 24, fx: 30, fy: 30, cx: 15.5, cy: 11.5, distortion: [0, 0, 0, 0, 0]}\n"
           "robot_from_camera: {x: 0.1, z: 0.3}\n";
    for (const char* name : {"10.5.png", "11.png", "9.25.jpg"})
      cv::imwrite(folder() / name, cv::Mat(24, 32, CV_8UC3, cv::Scalar(1, 80, 90)));
    std::ofstream(folder() / "poses.txt") << "9 0 0 0 0 0 0 1\n12 1 0 0 0 0 0 1\n";
  }

  std::filesystem::path folder() const { return scratch_.path() / "images"; }
  std::filesystem::path log() const { return scratch_.path() / "log.rawlog"; }

  ScratchDirectory scratch_;
};

TEST_F(ImageFolderTest, becomesARawlogByTime) {
  const ImportReport report = importImages(folder(), log());
  EXPECT_EQ(report.images, 3);
  EXPECT_EQ(report.ground_truth_poses, 2);
  EXPECT_TRUE(report.problems.empty());
  RawlogReader reader(log());
  RawlogEntry entry;
  for (const double time : {9.25, 10.5, 11.0}) {
    ASSERT_TRUE(reader.next(entry));
    EXPECT_NEAR(cameraObservation(*entry.observation).value().time, time, 1e-6);
  }
}

TEST_F(ImageFolderTest, namesImagesWithoutStampAndBrokenOnes) {
  cv::imwrite(folder() / "kitchen.png", cv::Mat(24, 32, CV_8UC3));
  std::ofstream(folder() / "12.png") << "garbage";
  const ImportReport report = importImages(folder(), log());
  EXPECT_EQ(report.images, 3);
  ASSERT_EQ(report.problems.size(), 2u);
  EXPECT_NE(report.problems[0].find("kitchen.png: its name is not a time stamp"), std::string::npos);
  EXPECT_NE(report.problems[1].find("12.png"), std::string::npos);
}

TEST_F(ImageFolderTest, refusesAFolderWithoutImages) {
  for (const char* name : {"10.5.png", "11.png", "9.25.jpg"}) std::filesystem::remove(folder() / name);
  EXPECT_THROW(importImages(folder(), log()), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(log()));
}

}  // namespace
}  // namespace vmcl
