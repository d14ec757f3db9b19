// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vmcl/geometry/random.h"

namespace vmcl {

/// An image of a surface being painted, in metres from its lower left corner. Colours are BGR. All randomness comes
/// from the generator given, so that a seed fixes the picture.
class Canvas {
 public:
  /// A part of a larger image shares its pixels.
  Canvas(cv::Mat image, double pixels_per_metre, Random& random)
      : image_(std::move(image)), scale_(pixels_per_metre), random_(random) {}

  double width() const { return image_.cols / scale_; }
  double height() const { return image_.rows / scale_; }
  Random& random() const { return random_; }
  const cv::Mat& image() const { return image_; }

  /// The part with the lower left corner (x, y), cut at the border; may be empty.
  Canvas part(double x, double y, double width, double height) const;

  void fill(const cv::Scalar& color) const { cv::Mat(image_).setTo(color); }
  void rectangle(double x, double y, double width, double height, const cv::Scalar& color) const;
  void ellipse(double x, double y, double radius_x, double radius_y, double turn_deg, const cv::Scalar& color) const;
  void line(double x0, double y0, double x1, double y1, double thickness, const cv::Scalar& color) const;
  void polygon(const std::vector<cv::Point2d>& corners, const cv::Scalar& color) const;

  /// Letters of the given height on the base line at y, as far as they fit.
  void text(double x, double y, double letter_height, const std::string& letters, const cv::Scalar& color) const;

  /// Brightens and darkens by up to `amount`, in soft blots about as large as given (m).
  void mottle(double amount, double blot_width, double blot_height) const;

  /// From the colour at the lower border to that at the upper one.
  void gradient(const cv::Scalar& lower, const cv::Scalar& upper) const;

 private:
  cv::Point2d pixel(double x, double y) const { return {x * scale_, image_.rows - y * scale_}; }

  cv::Mat image_;
  double scale_;
  Random& random_;
};

/// The colour times a factor.
cv::Scalar shaded(const cv::Scalar& color, double factor);

/// The colour, brighter or darker by up to `amount`.
cv::Scalar varied(const cv::Scalar& color, double amount, Random& random);

/// A strong colour of any hue.
cv::Scalar randomColor(Random& random);

}  // namespace vmcl
