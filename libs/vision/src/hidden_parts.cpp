// SPDX-License-Identifier: BSD-3-Clause
#include "hidden_parts.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vmcl {

HiddenParts::HiddenParts(const ImageMask& mask) {
  const ImageView& white = mask.white;
  if (white.empty()) return;
  const cv::Mat all(white.height, white.width, CV_8UC1, const_cast<uint8_t*>(white.pixels), white.row_bytes);
  hidden_ = all.rowRange(mask.rows_from_top, white.height) >= 128;
  cv::distanceTransform(~hidden_, pixels_to_hidden_, cv::DIST_L2, cv::DIST_MASK_5);
}

cv::Mat HiddenParts::filled(const cv::Mat& grey) const {
  if (hidden_.empty()) return grey;
  constexpr int reach = 61;  // pixels over which surroundings are averaged
  cv::Mat visible, sum, share, filled = grey.clone();
  cv::Mat(~hidden_).convertTo(visible, CV_32F, 1.0 / 255);
  grey.convertTo(sum, CV_32F);
  const cv::Scalar mean = cv::mean(grey, ~hidden_);
  cv::blur(sum.mul(visible), sum, {reach, reach});
  cv::blur(visible, share, {reach, reach});
  constexpr double share_of_mean = 1e-3;  // of the whole image, which is left where nothing near is visible
  cv::Mat average = (sum + share_of_mean * mean[0]) / (share + share_of_mean);
  average.convertTo(average, CV_8U);
  average.copyTo(filled, hidden_);
  return filled;
}

bool HiddenParts::touches(const cv::KeyPoint& keypoint) const {
  if (hidden_.empty()) return false;
  const int column = std::clamp(static_cast<int>(std::lround(keypoint.pt.x)), 0, hidden_.cols - 1);
  const int row = std::clamp(static_cast<int>(std::lround(keypoint.pt.y)), 0, hidden_.rows - 1);
  return pixels_to_hidden_.at<float>(row, column) <= keypoint.size / 2;
}

}  // namespace vmcl
