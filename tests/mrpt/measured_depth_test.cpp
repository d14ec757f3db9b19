// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/measured_depth.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <unistd.h>

#include <numbers>

namespace vmcl {
namespace {

using mrpt::obs::CObservation3DRangeScan;
constexpr double quarter_turn = std::numbers::pi / 2;

mrpt::img::TCamera camera(int columns, int rows, double focal) {
  mrpt::img::TCamera camera;
  camera.ncols = static_cast<uint32_t>(columns);
  camera.nrows = static_cast<uint32_t>(rows);
  camera.setIntrinsicParamsFromValues(focal, focal, (columns - 1) / 2.0, (rows - 1) / 2.0);
  return camera;
}

/// 8x6, a wall 2 m ahead, with a hole at row 1, column 2.
CObservation3DRangeScan wall() {
  CObservation3DRangeScan scan;
  scan.sensorLabel = "depth";
  scan.cameraParams = scan.cameraParamsIntensity = camera(8, 6, 10);
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, 0, 0, -quarter_turn, 0, -quarter_turn);
  scan.range_is_depth = true;
  scan.rangeUnits = 0.0002F;
  scan.hasRangeImage = true;
  scan.rangeImage_setSize(6, 8);
  scan.rangeImage.fill(10'000);
  scan.rangeImage(1, 2) = 0;
  return scan;
}

TEST(MeasuredDepth, UnitsAndHoles) {
  const DepthImage depth = measuredDepth(wall(), {});
  EXPECT_EQ(depth.width, 8);
  EXPECT_EQ(depth.height, 6);
  EXPECT_FLOAT_EQ(depth.depths[0], 2);
  EXPECT_EQ(depth.depths[8 + 2], 0);
}

TEST(MeasuredDepth, RangesAlongTheRayBecomeDepth) {
  CObservation3DRangeScan scan = wall();
  scan.range_is_depth = false;
  const DepthImage depth = measuredDepth(scan, {});
  EXPECT_NEAR(depth.depths[0], 2 / std::sqrt(1 + 0.35 * 0.35 + 0.25 * 0.25), 1e-6);
}

// The other camera is 0.5 m ahead of the wall's, with twice the resolution.
TEST(MeasuredDepth, MovesToTheCameraThatTookTheImage) {
  CObservation3DRangeScan scan = wall();
  scan.cameraParamsIntensity = camera(16, 12, 20);
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0.5, 0, 0, -quarter_turn, 0, -quarter_turn);
  const DepthImage depth = measuredDepth(scan, {});
  EXPECT_EQ(depth.width, 16);
  EXPECT_NEAR(depth.depths[6 * 16 + 8], 1.5, 1e-6);
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(3, 0, 0, -quarter_turn, 0, -quarter_turn);
  for (float behind : measuredDepth(scan, {}).depths) EXPECT_EQ(behind, 0);
}

TEST(MeasuredDepth, IsReadFromBesideTheLog) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("vmcl_measured_depth_test_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  CObservation3DRangeScan scan = wall();
  scan.rangeImage_convertToExternalStorage("wall.bin", folder.string() + "/");
  EXPECT_FLOAT_EQ(measuredDepth(scan, folder).depths[0], 2);
  EXPECT_THROW(measuredDepth(scan, folder / "nowhere"), std::runtime_error);
  scan.cameraParams.ncols = 9;
  EXPECT_THROW(measuredDepth(scan, folder), std::runtime_error);
  std::filesystem::resize_file(folder / "wall.bin", 20);
  scan.cameraParams.ncols = 8;
  EXPECT_THROW(measuredDepth(scan, folder), std::runtime_error);
  std::filesystem::remove_all(folder);
}

TEST(MeasuredDepth, OfAStereoCameraIsFromBothImages) {
  mrpt::obs::CObservationStereoImages pair;
  pair.sensorLabel = "pair";
  pair.leftCamera = pair.rightCamera = camera(80, 60, 100);
  pair.rightCameraPose = mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(0.1, 0, 0, 0, 0, 0));
  pair.imageLeft = mrpt::img::CImage(80, 60, mrpt::img::CH_GRAY);
  pair.imageRight = mrpt::img::CImage(80, 60, mrpt::img::CH_GRAY);
  uint32_t noise = 1;
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 90; ++column) {
      const auto grey = static_cast<uint8_t>((noise = 1664525 * noise + 1013904223) >> 24);
      if (column < 80) *pair.imageLeft.ptr<uint8_t>(column, row) = grey;
      if (column >= 5 && column < 85) *pair.imageRight.ptr<uint8_t>(column - 5, row) = grey;
    }
  EXPECT_TRUE(measuredDepth(pair, {}).empty());
  pair.hasImageRight = true;
  const DepthImage depth = measuredDepth(pair, {});
  ASSERT_EQ(depth.depths.size(), 80u * 60u);
  EXPECT_NEAR(depth.depths[30 * 80 + 50], 2, 0.05);  // 100 px * 0.1 m / 5 px
  pair.rightCameraPose = mrpt::poses::CPose3DQuat();
  EXPECT_THROW(measuredDepth(pair, {}), std::runtime_error);
}

TEST(MeasuredDepth, NoneAndBroken) {
  EXPECT_TRUE(measuredDepth(mrpt::obs::CObservationImage(), {}).empty());
  CObservation3DRangeScan scan = wall();
  scan.hasRangeImage = false;
  EXPECT_TRUE(measuredDepth(scan, {}).empty());
  const auto refused = [](void (*spoil)(CObservation3DRangeScan&), const char* reason) {
    CObservation3DRangeScan broken = wall();
    spoil(broken);
    try {
      measuredDepth(broken, {});
      ADD_FAILURE() << "accepted: " << reason;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("'depth'"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  refused([](auto& broken) { broken.rangeUnits = 0; }, "units");
  refused([](auto& broken) { broken.rangeImage_setSize(3, 3); }, "3x3");
  refused([](auto& broken) { broken.cameraParams = {}; }, "intrinsics");
  refused([](auto& broken) { broken.relativePoseIntensityWRTDepth.x(std::nan("")); }, "not finite");
}

}  // namespace
}  // namespace vmcl
