// SPDX-License-Identifier: BSD-3-Clause
#include "canvas.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vmcl {
namespace {

constexpr int sub_pixel_bits = 4;

cv::Point fixedPoint(const cv::Point2d& p) {
  return {static_cast<int>(std::lround(p.x * (1 << sub_pixel_bits))),
          static_cast<int>(std::lround(p.y * (1 << sub_pixel_bits)))};
}

}  // namespace

Canvas Canvas::part(double x, double y, double width, double height) const {
  const cv::Point2d low = pixel(x, y), high = pixel(x + width, y + height);
  const cv::Point corner(static_cast<int>(std::lround(low.x)), static_cast<int>(std::lround(high.y)));
  const cv::Point opposite(static_cast<int>(std::lround(high.x)), static_cast<int>(std::lround(low.y)));
  return {image_(cv::Rect(corner, opposite) & cv::Rect({}, image_.size())), scale_, random_};
}

void Canvas::rectangle(double x, double y, double width, double height, const cv::Scalar& color) const {
  part(x, y, width, height).fill(color);
}

void Canvas::ellipse(double x, double y, double radius_x, double radius_y, double turn_deg,
                     const cv::Scalar& color) const {
  if (image_.empty()) return;
  const auto axis = [this](double radius) {
    return std::max(1, static_cast<int>(std::lround(radius * scale_ * (1 << sub_pixel_bits))));
  };
  cv::ellipse(image_, fixedPoint(pixel(x, y)), cv::Size(axis(radius_x), axis(radius_y)), -turn_deg, 0, 360, color,
              cv::FILLED, cv::LINE_AA, sub_pixel_bits);
}

void Canvas::line(double x0, double y0, double x1, double y1, double thickness, const cv::Scalar& color) const {
  if (image_.empty()) return;
  const int thickness_px = std::max(1, static_cast<int>(std::lround(thickness * scale_)));
  cv::line(image_, fixedPoint(pixel(x0, y0)), fixedPoint(pixel(x1, y1)), color, thickness_px, cv::LINE_AA,
           sub_pixel_bits);
}

void Canvas::polygon(const std::vector<cv::Point2d>& corners, const cv::Scalar& color) const {
  if (image_.empty()) return;
  std::vector<cv::Point> points;
  for (const cv::Point2d& corner : corners) points.push_back(fixedPoint(pixel(corner.x, corner.y)));
  cv::fillPoly(image_, points, color, cv::LINE_AA, sub_pixel_bits);
}

void Canvas::text(double x, double y, double letter_height, const std::string& letters, const cv::Scalar& color) const {
  if (image_.empty()) return;
  const double font_scale = letter_height * scale_ / 21;  // capitals of this font are 21 pixels high at scale 1
  const int thickness_px = std::max(1, static_cast<int>(std::lround(2.5 * font_scale)));
  cv::putText(image_, letters, pixel(x, y), cv::FONT_HERSHEY_SIMPLEX, font_scale, color, thickness_px, cv::LINE_AA);
}

void Canvas::mottle(double amount, double blot_width, double blot_height) const {
  if (image_.empty()) return;
  const int columns = 3 + static_cast<int>(width() / blot_width), rows = 3 + static_cast<int>(height() / blot_height);
  cv::Mat noise(rows, columns, CV_32F);
  for (auto value = noise.begin<float>(); value != noise.end<float>(); ++value)
    *value = static_cast<float>(1 + random_.uniform(-amount, amount));
  cv::Mat factor, color;
  cv::resize(noise, factor, image_.size(), 0, 0, cv::INTER_CUBIC);
  cv::cvtColor(factor, factor, cv::COLOR_GRAY2BGR);
  image_.convertTo(color, CV_32F);
  color = color.mul(factor);
  color.convertTo(image_, CV_8U);
}

void Canvas::gradient(const cv::Scalar& lower, const cv::Scalar& upper) const {
  for (int row = 0; row < image_.rows; ++row) {
    const double share = (row + 0.5) / image_.rows;
    image_.row(row).setTo(share * lower + (1 - share) * upper);
  }
}

cv::Scalar shaded(const cv::Scalar& color, double factor) { return color * factor; }

cv::Scalar varied(const cv::Scalar& color, double amount, Random& random) {
  return color * (1 + random.uniform(-amount, amount));
}

cv::Scalar randomColor(Random& random) {
  const double hue = random.uniform(0, 6), bright = random.uniform(90, 245), dull = bright * random.uniform(0.1, 0.7);
  const double between = dull + (bright - dull) * std::abs(std::fmod(hue, 2.0) - 1);
  switch (static_cast<int>(hue)) {
    case 0:
      return {dull, between, bright};
    case 1:
      return {dull, bright, between};
    case 2:
      return {between, bright, dull};
    case 3:
      return {bright, between, dull};
    case 4:
      return {bright, dull, between};
    default:
      return {between, dull, bright};
  }
}

}  // namespace vmcl
