// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/rawlog_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "scratch_directory.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/mrpt/camera_observation.h"

namespace vmcl {
namespace {

mrpt::obs::CObservationOdometry odometryAt(double time) {
  mrpt::obs::CObservationOdometry odometry;
  odometry.sensorLabel = "odometry";
  odometry.timestamp = mrpt::Clock::fromDouble(time);
  return odometry;
}

mrpt::obs::CObservationImage cameraAt(double time) {
  mrpt::obs::CObservationImage camera;
  camera.sensorLabel = "camera";
  camera.timestamp = mrpt::Clock::fromDouble(time);
  camera.cameraParams.ncols = 32;
  camera.cameraParams.nrows = 24;
  camera.cameraParams.setIntrinsicParamsFromValues(30, 30, 16, 12);
  return camera;
}

std::string greyPng(int grey) {
  std::vector<uint8_t> bytes;
  cv::imencode(".png", cv::Mat(24, 32, CV_8U, cv::Scalar(grey)), bytes);
  return {bytes.begin(), bytes.end()};
}

void writeLog(const std::filesystem::path& log, int grey) {
  RawlogWriter writer(log);
  writer.write(odometryAt(100));
  writer.write(cameraAt(100.25), greyPng(grey), ".png");
  writer.write(odometryAt(100.5));
  writer.commit();
}

std::string outputOf(const std::string& command) {
  std::string output;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  char buffer[256];
  while (fgets(buffer, sizeof buffer, pipe)) output += buffer;
  pclose(pipe);
  return output;
}

TEST(RawlogCompanion, replacesTheExtensionOfPlainAndCompressedLogs) {
  EXPECT_EQ(rawlogCompanion("a/b.rawlog", "_Images"), "a/b_Images");
  EXPECT_EQ(rawlogCompanion("a/b.rawlog.gz", ".groundtruth.tum"), "a/b.groundtruth.tum");
}

TEST(RawlogWriter, writesWhatTheReaderReads) {
  const ScratchDirectory scratch;
  const auto log = scratch.path() / "drive.rawlog";
  writeLog(log, 77);
  RawlogReader reader(log);
  RawlogEntry entry;
  ASSERT_TRUE(reader.next(entry));
  EXPECT_NEAR(mrpt::Clock::toDouble(entry.observation->timestamp), 100, 1e-6);
  ASSERT_TRUE(reader.next(entry));
  const auto camera = cameraObservation(*entry.observation);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->image.pixels, std::vector<uint8_t>(32 * 24, 77));
  ASSERT_TRUE(reader.next(entry));
  EXPECT_FALSE(reader.next(entry));
}

TEST(RawlogWriter, replacesAnOlderLogAndItsImages) {
  const ScratchDirectory scratch;
  const auto log = scratch.path() / "drive.rawlog";
  writeLog(log, 1);
  std::ofstream(scratch.path() / "drive_Images" / "camera_000007.png") << "of the older log";
  writeLog(log, 2);
  int files = 0;
  for (const auto& item : std::filesystem::recursive_directory_iterator(scratch.path()))
    files += item.is_regular_file();
  EXPECT_EQ(files, 2);
}

TEST(RawlogWriter, leavesTheOlderImagesWhenTheLogCannotBeReplaced) {
  const ScratchDirectory scratch;
  const auto log = scratch.path() / "drive.rawlog", older = scratch.path() / "drive_Images" / "older.png";
  std::filesystem::create_directories(log / "a directory that no file replaces");
  std::filesystem::create_directory(older.parent_path());
  std::ofstream(older) << "of the older log";
  EXPECT_THROW(writeLog(log, 1), std::runtime_error);
  EXPECT_TRUE(std::filesystem::exists(older));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()), {}), 2);
}

TEST(RawlogWriter, touchesNoFolderThatBelongsToNoLog) {
  const ScratchDirectory scratch;
  const auto log = scratch.path() / "drive.rawlog", others = scratch.path() / "drive_Images" / "holiday.png";
  std::filesystem::create_directory(others.parent_path());
  std::ofstream(others) << "of somebody else";
  EXPECT_THAT([&] { writeLog(log, 1); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("drive_Images")));
  EXPECT_TRUE(std::filesystem::exists(others));
  EXPECT_FALSE(std::filesystem::exists(log));
  std::filesystem::remove(others);
  EXPECT_NO_THROW(writeLog(log, 1));
}

TEST(RawlogWriter, leavesNothingWithoutCommit) {
  const ScratchDirectory scratch;
  {
    RawlogWriter writer(scratch.path() / "drive.rawlog");
    writer.write(cameraAt(1), greyPng(1), ".png");
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
  EXPECT_THROW(RawlogWriter(scratch.path() / "missing" / "drive.rawlog"), std::runtime_error);
}

TEST(RawlogWriter, stockRawlogEditReadsLogAndImages) {
  if (std::system("command -v rawlog-edit > /dev/null") != 0) GTEST_SKIP() << "rawlog-edit is not installed";
  const ScratchDirectory scratch;
  const auto log = scratch.path() / "drive.rawlog";
  writeLog(log, 77);
  // MRPT 2.5.8 finds the images of a log in the working directory only
  const std::string there = "cd " + scratch.path().string() + " && rawlog-edit -i drive.rawlog ";
  const std::string info = outputOf(there + "--info");
  EXPECT_NE(info.find("Found external storage directory: drive_Images"), std::string::npos) << info;
  EXPECT_NE(info.find("Overall number of objects         : 3"), std::string::npos) << info;
  const std::string listing = outputOf(there + "--list-images --text-file-output images.txt");
  std::ifstream in(scratch.path() / "images.txt");
  std::string image;
  ASSERT_TRUE(std::getline(in, image)) << listing;
  EXPECT_NE(image.find("camera_000000.png"), std::string::npos) << image;
}

}  // namespace
}  // namespace vmcl
