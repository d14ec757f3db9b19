// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/stereo_depth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

constexpr double nearest = 0.3;          // m
constexpr double least_disparity = 1;    // px
constexpr int most_disparities = 512;    // px
constexpr double largest_angle = 0.26;   // rad
constexpr double largest_baseline = 10;  // m
constexpr int most_pixels = 16384;       // OpenCV keeps columns and rows in 16 bits

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

void checkSize(const Image& image, const PinholeCamera& camera, const std::string& name) {
  require(image.width == camera.width && image.height == camera.height &&
              std::ssize(image.pixels) == std::ptrdiff_t{camera.width} * camera.height,
          "the " + name + " image has another size than its calibration");
}

/// Rotation to a frame whose x axis is the baseline and which looks midway between the two cameras.
Eigen::Matrix3d rectifiedFromLeft(const Rigid3& left_from_right) {
  const Eigen::Vector3d x = left_from_right.translation().normalized();
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ() + left_from_right.linear().col(2);
  const Eigen::Vector3d y = ahead.cross(x).normalized();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), y.transpose(), x.cross(y).transpose();
  return rotation;
}

/// The image as the pinhole would see it, turned.
cv::Mat rectified(const Image& image, const CameraCalibration& camera, const Eigen::Matrix3d& rectified_from_camera,
                  const PinholeCamera& pinhole) {
  cv::Mat from_matrix, to_matrix, rotation, columns, rows, seen;
  cv::eigen2cv(camera.pinhole.matrix(), from_matrix);
  cv::eigen2cv(pinhole.matrix(), to_matrix);
  cv::eigen2cv(rectified_from_camera, rotation);
  const cv::Mat distortion(1, 5, CV_64F, const_cast<double*>(camera.distortion.data()));
  cv::initUndistortRectifyMap(from_matrix, distortion, rotation, to_matrix, {pinhole.width, pinhole.height}, CV_32FC1,
                              columns, rows);
  const cv::Mat taken(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data()));
  cv::remap(taken, seen, columns, rows, cv::INTER_LINEAR);
  return seen;
}

/// Disparities of the left image in sixteenths of a pixel, below 16 where there is none.
cv::Mat disparities(cv::Mat left, cv::Mat right, int count) {
  constexpr int window = 5;
  // The matcher leaves out as many columns on the left as there are disparities: these may show what is near the
  // middle.
  for (cv::Mat* image : {&left, &right}) cv::copyMakeBorder(*image, *image, 0, 0, count, 0, cv::BORDER_REPLICATE);
  const auto matcher = cv::StereoSGBM::create(0, count, window, 8 * window * window, 32 * window * window);
  matcher->setDisp12MaxDiff(1);
  matcher->setUniquenessRatio(10);
  matcher->setSpeckleWindowSize(100);
  matcher->setSpeckleRange(2);
  cv::Mat found;
  matcher->compute(left, right, found);
  return found.colRange(count, found.cols);
}

}  // namespace

void StereoPair::check() const {
  left.check();
  right.check();
  require(left_from_right.matrix().allFinite(), "the pose of the right camera is not finite");
  const Eigen::Vector3d& baseline = left_from_right.translation();
  require(baseline.norm() > 1e-3, "the two cameras are at one place");
  require(baseline.norm() < largest_baseline, "the two cameras are over 10 m apart");
  for (const CameraCalibration* camera : {&left, &right})
    require(std::max(camera->pinhole.width, camera->pinhole.height) <= most_pixels,
            "an image is over " + std::to_string(most_pixels) + " pixels wide or high");
  require(baseline.x() > std::cos(largest_angle) * baseline.norm(),
          "the second camera is not to the right of the first");
  require(Eigen::AngleAxisd(left_from_right.linear()).angle() < largest_angle, "the two cameras look apart");
}

DepthImage stereoDepth(const StereoPair& pair, const Image& left, const Image& right) {
  pair.check();
  checkSize(left, pair.left.pinhole, "left");
  checkSize(right, pair.right.pinhole, "right");
  const PinholeCamera& pinhole = pair.left.pinhole;  // of both images once they are rectified
  const Eigen::Matrix3d turn = rectifiedFromLeft(pair.left_from_right);
  const double baseline = pair.left_from_right.translation().norm();
  const double largest = std::min(pinhole.fx * baseline / nearest, most_disparities - 16.0);
  const int count = std::min(static_cast<int>(largest) / 16 * 16 + 16, (pinhole.width + 15) / 16 * 16);
  const cv::Mat found = disparities(rectified(left, pair.left, turn, pinhole),
                                    rectified(right, pair.right, turn * pair.left_from_right.linear(), pinhole), count);
  DepthImage depth{pinhole.width, pinhole.height, {}};
  depth.depths.reserve(left.pixels.size());
  for (int v = 0; v < pinhole.height; ++v)
    for (int u = 0; u < pinhole.width; ++u) {
      const Eigen::Vector3d ray = turn * pinhole.ray(pair.left.undistort(Eigen::Vector2d(u, v)));
      const Eigen::Vector2d pixel = pinhole.project(ray);
      const bool is_seen = ray.z() > 0 && pinhole.contains(pixel);
      const double disparity = is_seen ? found.at<short>(static_cast<int>(std::lround(pixel.y())),
                                                         static_cast<int>(std::lround(pixel.x()))) /
                                             16.0
                                       : 0;
      const bool is_known = disparity >= least_disparity && disparity <= pixel.x();  // the right image shows it, too
      // Along the ray, whose z is 1 in the left camera.
      depth.depths.push_back(is_known ? static_cast<float>(pinhole.fx * baseline / disparity / ray.z()) : 0);
    }
  return depth;
}

}  // namespace vmcl
