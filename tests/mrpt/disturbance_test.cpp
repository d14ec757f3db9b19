// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/disturbance.h"

#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <limits>
#include <stdexcept>

namespace vmcl {
namespace {

using namespace mrpt::obs;

class DisturbanceTest : public ::testing::Test {
 protected:
  template <class Observation>
  static std::shared_ptr<Observation> at(double time) {
    auto observation = std::make_shared<Observation>();
    observation->timestamp = mrpt::Clock::fromDouble(time);
    return observation;
  }

  static CObservationImage::Ptr image(double time, uint8_t grey = 200) {
    auto observation = at<CObservationImage>(time);
    observation->image = mrpt::img::CImage(4, 3, mrpt::img::CH_GRAY);
    observation->image.filledRectangle(0, 0, 3, 2, mrpt::img::TColor(grey, grey, grey));
    return observation;
  }

  static int greyOf(const mrpt::img::CImage& image) { return *image.ptr<uint8_t>(1, 1); }

  /// What is left of the image at the time of a log that begins at 100.
  static int greyAt(const Dimming& dimming, double time) {
    DisturbedDrive log({0, dimming, 1}, 1);
    const auto camera = image(time);
    EXPECT_TRUE(log.disturb(nullptr, nullptr, at<CObservationOdometry>(100).get()));
    EXPECT_TRUE(log.disturb(nullptr, nullptr, camera.get()));
    return greyOf(camera->image);
  }

  static int lostOf(int images, double share, uint64_t seed) {
    DisturbedDrive log({share, std::nullopt, 1}, seed);
    int lost = 0;
    for (int i = 0; i < images; ++i) {
      lost += !log.disturb(nullptr, nullptr, image(i).get());
    }
    return lost;
  }
};

TEST_F(DisturbanceTest, LosesTheShareOfTheImages) {
  // Seeds 1 to 5; 600 of 2000 with a deviation of 20.5: 5 of them, chance of a false alarm 3e-6.
  for (uint64_t seed = 1; seed <= 5; ++seed) EXPECT_NEAR(lostOf(2000, 0.3, seed), 600, 103);
  EXPECT_EQ(lostOf(100, 0, 1), 0);
}

TEST_F(DisturbanceTest, TheSameSeedLosesTheSameImages) {
  EXPECT_EQ(lostOf(500, 0.5, 3), lostOf(500, 0.5, 3));
  DisturbedDrive one({0.5, std::nullopt, 1}, 1), other({0.5, std::nullopt, 1}, 2);
  int differences = 0;
  for (int i = 0; i < 100; ++i)
    differences += one.disturb(nullptr, nullptr, image(i).get()) != other.disturb(nullptr, nullptr, image(i).get());
  EXPECT_GT(differences, 0);
}

TEST_F(DisturbanceTest, OnlyImagesGetLost) {
  DisturbedDrive log({0.99, std::nullopt, 1}, 1);
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(log.disturb(nullptr, nullptr, at<CObservationOdometry>(i).get()));
    EXPECT_TRUE(log.disturb(nullptr, nullptr, at<CObservation2DRangeScan>(i).get()));
  }
}

TEST_F(DisturbanceTest, AFrameLosesItsImageAndKeepsItsScan) {
  DisturbedDrive log({0.99, std::nullopt, 1}, 1);
  CSensoryFrame frame;
  frame.insert(image(1));
  frame.insert(at<CObservation2DRangeScan>(1));
  EXPECT_TRUE(log.disturb(nullptr, &frame, nullptr));
  ASSERT_EQ(frame.size(), 1U);
  EXPECT_TRUE(frame.getObservationByClass<CObservation2DRangeScan>());
}

TEST_F(DisturbanceTest, ImagesAreDimWhileItIsDark) {
  const Dimming dark{20, 10, 0.1};
  EXPECT_EQ(greyAt(dark, 119.9), 200);
  EXPECT_EQ(greyAt(dark, 120), 20);
  EXPECT_EQ(greyAt(dark, 129.9), 20);
  EXPECT_EQ(greyAt(dark, 130), 200);
  EXPECT_EQ(greyAt({20, 10, 0}, 125), 0);
}

TEST_F(DisturbanceTest, ADepthCamerasImageIsDimToo) {
  DisturbedDrive log({0, Dimming{0, 10, 0}, 1}, 1);
  auto camera = at<CObservation3DRangeScan>(1);
  camera->hasIntensityImage = true;
  camera->intensityImage = image(1)->image;
  EXPECT_TRUE(log.disturb(nullptr, nullptr, camera.get()));
  EXPECT_EQ(greyOf(camera->intensityImage), 0);
}

TEST_F(DisturbanceTest, BothImagesOfAStereoCameraAreDim) {
  DisturbedDrive log({0, Dimming{0, 10, 0}, 1}, 1);
  auto pair = at<mrpt::obs::CObservationStereoImages>(1);
  pair->imageLeft = pair->imageRight = image(1)->image;
  EXPECT_TRUE(log.disturb(nullptr, nullptr, pair.get()));
  EXPECT_EQ(greyOf(pair->imageLeft), 0);
  EXPECT_EQ(greyOf(pair->imageRight), 0);
}

TEST_F(DisturbanceTest, AnImageThatCannotBeReadStays) {
  DisturbedDrive log({0, Dimming{0, 10, 0}, 1}, 1);
  auto camera = at<CObservationImage>(1);
  camera->image.setExternalStorage("nowhere.png");
  EXPECT_TRUE(log.disturb(nullptr, nullptr, camera.get()));
  EXPECT_TRUE(camera->image.isExternallyStored());
}

TEST_F(DisturbanceTest, TheOdometryTellsScaledDistances) {
  DisturbedDrive log({0, std::nullopt, 1.1}, 1);
  auto odometry = at<CObservationOdometry>(1);
  odometry->odometry = {1, -2, 0.5};
  CActionCollection actions;
  CActionRobotMovement2D movement;
  movement.computeFromOdometry({0.2, 0.1, 0.3}, {});
  actions.insert(movement);
  EXPECT_TRUE(log.disturb(&actions, nullptr, odometry.get()));
  EXPECT_NEAR(odometry->odometry.x(), 1.1, 1e-12);
  EXPECT_NEAR(odometry->odometry.y(), -2.2, 1e-12);
  EXPECT_NEAR(odometry->odometry.phi(), 0.5, 1e-12);
  const auto scaled = actions.getBestMovementEstimation()->rawOdometryIncrementReading;
  EXPECT_NEAR(scaled.x(), 0.22, 1e-12);
  EXPECT_NEAR(scaled.y(), 0.11, 1e-12);
  EXPECT_NEAR(scaled.phi(), 0.3, 1e-12);
}

TEST_F(DisturbanceTest, RefusesWhatMakesNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Disturbance& bad : {Disturbance{1, {}, 1}, Disturbance{-0.1, {}, 1}, Disturbance{nan, {}, 1},
                                 Disturbance{0, {}, 0}, Disturbance{0, {}, nan}, Disturbance{0, Dimming{-1, 1, 0}, 1},
                                 Disturbance{0, Dimming{1, 0, 0}, 1}, Disturbance{0, Dimming{1, 1, 2}, 1}})
    EXPECT_THROW((DisturbedDrive{bad, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
