// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/place_network.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "network.h"

namespace vmcl {
namespace {

/// The numbers of the only output, whatever their shape.
Eigen::VectorXf onlyOutput(const Network& network, const cv::Mat& image) {
  const std::vector<cv::Mat> outputs = network.run({&image, 1});
  if (outputs.size() != 1) network.refuse("it has " + std::to_string(outputs.size()) + " outputs, not one");
  return Eigen::Map<const Eigen::VectorXf>(outputs[0].ptr<float>(), static_cast<Eigen::Index>(outputs[0].total()));
}

/// A copy with what the robot's own parts show painted over.
cv::Mat withoutHidden(const cv::Mat& image, const ImageMask& mask) {
  const auto grey = cv::Scalar::all(128);
  cv::Mat painted = image.clone();
  painted.rowRange(0, mask.rows_from_top).setTo(grey);
  if (!mask.white.empty()) {
    const cv::Mat white(mask.white.height, mask.white.width, CV_8UC1, const_cast<uint8_t*>(mask.white.pixels),
                        mask.white.row_bytes);
    painted.setTo(grey, white >= 128);
  }
  return painted;
}

}  // namespace

PlaceNetwork::PlaceNetwork(FeatureModel& model) : network_(std::make_unique<Network>(model.file, model.crc32, 1)) {
  constexpr int most = 4096;  // sides of an image to look at
  const cv::Size size = network_->inputSize({320, 240});
  if (size.width > most || size.height > most) network_->refuse("its input is larger than 4096 x 4096");
  size_ = static_cast<int>(onlyOutput(*network_, cv::Mat(size, CV_8U, cv::Scalar(128))).size());  // seen by running
  if (size_ < 2 || size_ > max_size)
    network_->refuse("its output has " + std::to_string(size_) + " numbers, not 2 to " + std::to_string(max_size));
}

PlaceNetwork::~PlaceNetwork() = default;
PlaceNetwork::PlaceNetwork(PlaceNetwork&&) noexcept = default;

Eigen::VectorXf PlaceNetwork::describe(const ImageView& image, const ImageMask& mask) const {
  if (image.empty() || (image.channels != 1 && image.channels != 3))
    throw std::invalid_argument("no image of one or three channels to describe");
  mask.check(image.width, image.height);
  const cv::Mat pixels(image.height, image.width, image.channels == 1 ? CV_8UC1 : CV_8UC3,
                       const_cast<uint8_t*>(image.pixels), image.row_bytes);
  cv::Mat seen = withoutHidden(pixels, mask);
  if (network_->isGrey() && seen.channels() == 3) cv::cvtColor(seen, seen, cv::COLOR_BGR2GRAY);
  const cv::Size size = network_->inputSize(seen.size());
  if (size.empty()) throw std::invalid_argument("an image of less than 8 pixels has no description");
  if (size != seen.size()) cv::resize(seen, seen, size, 0, 0, cv::INTER_AREA);
  const Eigen::VectorXf output = onlyOutput(*network_, seen);
  if (output.size() != size_)
    network_->refuse("its output has " + std::to_string(output.size()) + " numbers for an image of " +
                     std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels, " +
                     std::to_string(size_) + " for another: it is none of whole images");
  return output.stableNormalized();
}

}  // namespace vmcl
