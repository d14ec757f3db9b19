// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/image_formation.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace vmcl {
namespace {

SimulatedCamera quietCamera() {
  SimulatedCamera camera;
  camera.calibration.pinhole = {160, 120, 110, 112, 78, 61};
  camera.sigma_grey = 0;
  return camera;
}

/// A dark image with a bright dot at this pixel.
cv::Mat dotAt(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  cv::Mat image(camera.height, camera.width, CV_8UC3, cv::Scalar::all(0));
  cv::circle(image, cv::Point(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())), 2, cv::Scalar::all(200), -1);
  return image;
}

Eigen::Vector2d centreOfLight(const cv::Mat& image) {
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  const cv::Moments m = cv::moments(grey);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

TEST(ImageFormation, withoutFaultsTheImageIsTheIdealOne) {
  const ImageFormation formation(quietCamera());
  const cv::Mat ideal = dotAt(formation.ideal(), {30, 40});
  Random random(1);
  EXPECT_EQ(cv::norm(ideal, formation.image(ideal, {1, 1, 1}, 1, random), cv::NORM_INF), 0);
}

TEST(ImageFormation, bendsPixelsAsTheCalibrationSays) {
  SimulatedCamera camera = quietCamera();
  camera.calibration.distortion = {-0.2, 0.05, 0.001, -0.002, 0};
  const ImageFormation formation(camera);
  const Eigen::Vector2d corner(formation.ideal().cx - camera.calibration.pinhole.cx,
                               formation.ideal().cy - camera.calibration.pinhole.cy);
  EXPECT_GT(formation.ideal().width, 160);  // the lens bends more of the world into the image
  Random random(1);
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(20, 20), Eigen::Vector2d(140, 30), Eigen::Vector2d(70, 100)}) {
    const cv::Mat bent = formation.image(dotAt(formation.ideal(), pixel + corner), {0, 0, 0}, 1, random);
    EXPECT_LT((centreOfLight(bent) - camera.calibration.distort(pixel)).norm(), 0.3) << pixel.transpose();
  }
}

TEST(ImageFormation, aTurningCameraBlursAlongItsTurn) {
  SimulatedCamera camera = quietCamera();
  camera.exposure_time = 0.05;
  const ImageFormation formation(camera);
  Random random(1);
  const cv::Mat blurred = formation.image(dotAt(formation.ideal(), {78, 61}), {0, 2, 0}, 1, random);
  cv::Mat grey;
  cv::cvtColor(blurred, grey, cv::COLOR_BGR2GRAY);
  const cv::Rect extent = cv::boundingRect(grey > 5);
  EXPECT_NEAR(extent.width, 5 + 0.05 * 2 * 110, 3);
  EXPECT_LE(extent.height, 6);
  EXPECT_LT((centreOfLight(blurred) - Eigen::Vector2d(78, 61)).norm(), 0.3);
}

TEST(ImageFormation, gainBrightens) {
  const ImageFormation formation(quietCamera());
  Random random(1);
  const cv::Mat grey(120, 160, CV_8UC3, cv::Scalar::all(100));
  EXPECT_NEAR(cv::mean(formation.image(grey, {0, 0, 0}, 1.3, random))[0], 130, 0.5);
}

TEST(ImageFormation, depthNoiseGrowsWithTheSquareOfTheDistance) {
  SimulatedCamera camera = quietCamera();
  camera.depth = SimulatedDepth{5, 0.01};
  const ImageFormation formation(camera);
  Random random(4);
  for (const double distance : {1.0, 3.0}) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(formation.depth(cv::Mat(120, 160, CV_32F, cv::Scalar(distance)), random), mean, deviation);
    const double sigma = 10 * distance * distance;  // mm, of 19200 pixels: both within five standard errors
    EXPECT_NEAR(mean[0], 1000 * distance, 5 * sigma / std::sqrt(19200.0));
    EXPECT_NEAR(deviation[0], sigma, 5 * sigma / std::sqrt(2 * 19200.0));
  }
  EXPECT_EQ(cv::countNonZero(formation.depth(cv::Mat(120, 160, CV_32F, cv::Scalar(7)), random)), 0);
}

}  // namespace
}  // namespace vmcl
