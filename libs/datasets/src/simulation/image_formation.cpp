// SPDX-License-Identifier: BSD-3-Clause
#include "image_formation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vmcl {
namespace {

constexpr double widest = 3;  // times the real image that the ideal one may be

void addNoise(cv::Mat& image, double sigma, Random& random) {
  for (auto pixel = image.begin<cv::Vec3b>(); pixel != image.end<cv::Vec3b>(); ++pixel) {
    const int noise = static_cast<int>(std::lround(sigma * random.normal()));
    for (uchar& channel : (*pixel).val) channel = static_cast<uchar>(std::clamp(channel + noise, 0, 255));
  }
}

}  // namespace

ImageFormation::ImageFormation(const SimulatedCamera& camera) : camera_(camera), ideal_(camera.calibration.pinhole) {
  if (!camera.calibration.isDistorted()) return;
  const PinholeCamera& real = camera.calibration.pinhole;
  map_ = cv::Mat(real.height, real.width, CV_32FC2);
  Eigen::Vector2d low(0, 0), high(real.width - 1, real.height - 1);
  const Eigen::Vector2d spare = (widest - 1) / 2 * Eigen::Vector2d(real.width, real.height);
  for (int v = 0; v < real.height; ++v)
    for (int u = 0; u < real.width; ++u) {
      const Eigen::Vector2d pixel = camera.calibration.undistort({u, v}).cwiseMax(-spare).cwiseMin(high + spare);
      map_.at<cv::Vec2f>(v, u) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
  const Eigen::Vector2d corner = low.array().floor();
  ideal_.width = static_cast<int>(std::ceil(high.x() - corner.x())) + 1;
  ideal_.height = static_cast<int>(std::ceil(high.y() - corner.y())) + 1;
  ideal_.cx -= corner.x();
  ideal_.cy -= corner.y();
  map_ -= cv::Scalar(corner.x(), corner.y());
}

cv::Mat ImageFormation::blurred(const cv::Mat& image, const Eigen::Vector3d& turn_rate) const {
  const double angle = turn_rate.norm() * camera_.exposure_time;
  const int shots = std::clamp(static_cast<int>(std::ceil(angle * ideal_.fx)), 1, 12);
  if (shots == 1) return image;
  cv::Mat sum(image.size(), CV_32FC3, cv::Scalar::all(0)), turned;
  for (int i = 0; i < shots; ++i) {
    const double share = (i + 0.5) / shots - 0.5;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(share * angle, turn_rate.normalized()).toRotationMatrix();
    const Eigen::Matrix3d homography = ideal_.matrix() * turn.transpose() * ideal_.inverseMatrix();
    cv::Matx33d h;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) h(row, column) = homography(row, column);
    cv::warpPerspective(image, turned, h, image.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::accumulate(turned, sum);
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_8UC3, 1.0 / shots);
  return mean;
}

cv::Mat ImageFormation::image(const cv::Mat& ideal_bgr, const Eigen::Vector3d& turn_rate, double gain,
                              Random& random) const {
  cv::Mat image = camera_.exposure_time > 0 ? blurred(ideal_bgr, turn_rate) : ideal_bgr;
  if (!map_.empty()) {
    cv::Mat bent;
    cv::remap(image, bent, map_, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    image = bent;
  }
  if (gain != 1) image = image * gain;
  addNoise(image, camera_.sigma_grey, random);
  return image;
}

cv::Mat ImageFormation::depth(const cv::Mat& ideal_depth, Random& random) const {
  cv::Mat metres = ideal_depth;
  if (!map_.empty()) cv::remap(ideal_depth, metres, map_, {}, cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  cv::Mat millimetres(metres.size(), CV_16U);
  const SimulatedDepth& model = camera_.depth.value();
  for (int row = 0; row < metres.rows; ++row)
    for (int column = 0; column < metres.cols; ++column) {
      const double z = metres.at<float>(row, column);
      const double measured = z + model.sigma * z * z * random.normal();
      const bool is_valid = z > 0 && z <= model.max_range && measured > 0;
      millimetres.at<uint16_t>(row, column) = is_valid ? cv::saturate_cast<uint16_t>(1000 * measured) : 0;
    }
  return millimetres;
}

}  // namespace vmcl
