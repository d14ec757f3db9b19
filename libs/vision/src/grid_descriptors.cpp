// SPDX-License-Identifier: BSD-3-Clause
#include "grid_descriptors.h"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace vmcl {
namespace {

constexpr int directions = 8;
constexpr int side = 4;                 // histograms along each
constexpr float spacing = 12;           // pixels between their centres
constexpr float min_mean_gradient = 1;  // grey levels a pixel; less is noise

/// Strength of the gradient along each direction, averaged over the pixels that belong to a histogram, of the image at
/// half its size.
std::array<cv::Mat, directions> directedGradients(const cv::Mat& grey) {
  cv::Mat half, along_x, along_y;
  cv::resize(grey, half, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::GaussianBlur(half, half, {}, 1);
  cv::Scharr(half, along_x, CV_32F, 1, 0, 1 / 32.0);
  cv::Scharr(half, along_y, CV_32F, 0, 1, 1 / 32.0);
  std::array<cv::Mat, directions> gradients;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    cv::Mat strength = std::cos(angle) * along_x + std::sin(angle) * along_y;
    strength = cv::max(strength, 0);
    cv::GaussianBlur(strength, gradients[static_cast<std::size_t>(k)], {}, spacing / 4);
  }
  return gradients;
}

}  // namespace

GridDescriptors describePoints(const cv::Mat& grey, std::span<const Eigen::Vector2f> points) {
  const std::array<cv::Mat, directions> gradients = directedGradients(grey);
  GridDescriptors found;
  found.descriptors.resize(static_cast<Eigen::Index>(points.size()), side * side * directions);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<float, side * side * directions> histogram;
    float sum = 0;
    for (int cell = 0; cell < side * side; ++cell) {
      const float dx = spacing * (static_cast<float>(cell % side) - 1.5f);
      const float dy = spacing * (static_cast<float>(cell / side) - 1.5f);
      const int column = static_cast<int>(std::lround((points[i].x() + dx) / 2 - 0.25f));
      const int row = static_cast<int>(std::lround((points[i].y() + dy) / 2 - 0.25f));
      for (int k = 0; k < directions; ++k) {
        const cv::Mat& gradient = gradients[static_cast<std::size_t>(k)];
        const bool is_inside = column >= 0 && row >= 0 && column < gradient.cols && row < gradient.rows;
        sum += histogram[static_cast<std::size_t>(cell * directions + k)] =
            is_inside ? gradient.at<float>(row, column) : 0;
      }
    }
    if (sum < side * side * min_mean_gradient) continue;
    auto descriptor = found.descriptors.row(static_cast<Eigen::Index>(found.points.size()));
    for (std::size_t k = 0; k < histogram.size(); ++k)
      descriptor[static_cast<Eigen::Index>(k)] =
          static_cast<uint8_t>(std::min(255.0f, std::round(512 * std::sqrt(histogram[k] / sum))));
    found.points.push_back(static_cast<int>(i));
  }
  found.descriptors.conservativeResize(static_cast<Eigen::Index>(found.points.size()), Eigen::NoChange);
  return found;
}

}  // namespace vmcl
