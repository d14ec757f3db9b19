// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/match_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "network.h"

namespace vmcl {
namespace {

constexpr float least_confidence = 0.5f;
constexpr float most_stretched = 3;  // neighbouring cells lie at most so many times as far apart in the query

/// What the network says of a pair of images.
struct Warp {
  cv::Mat x, y, confidence;  ///< one number a cell of the reference, rows from the top
};

cv::Mat channelOf(const cv::Mat& output, int channel) {
  return cv::Mat(output.size[2], output.size[3], CV_32F, const_cast<float*>(output.ptr<float>(0, channel))).clone();
}

Warp runOn(const Network& network, const std::array<cv::Mat, 2>& images) {
  std::vector<cv::Mat> outputs = network.run(images);
  if (outputs.size() != 2) network.refuse("it has " + std::to_string(outputs.size()) + " outputs, not two");
  for (const cv::Mat& output : outputs)
    if (output.dims != 4 || output.size[0] != 1 || output.size[2] < 2 || output.size[3] < 2)
      network.refuse("an output is not 1 x channels x height x width of cells");
  if (outputs[0].size[1] == 1) std::swap(outputs[0], outputs[1]);
  if (outputs[0].size[1] != 2 || outputs[1].size[1] != 1 || outputs[0].size[2] != outputs[1].size[2] ||
      outputs[0].size[3] != outputs[1].size[3])
    network.refuse("its outputs are not places (2 channels) and confidences (1 channel) of the same cells");
  return {channelOf(outputs[0], 0), channelOf(outputs[0], 1), channelOf(outputs[1], 0)};
}

/// In the size and colours that the network takes.
cv::Mat inputOf(const Network& network, const ImageView& view) {
  if (view.empty() || (view.channels != 1 && view.channels != 3))
    throw std::invalid_argument("no image of one or three channels to match");
  cv::Mat image(view.height, view.width, view.channels == 1 ? CV_8UC1 : CV_8UC3, const_cast<uint8_t*>(view.pixels),
                view.row_bytes);
  if (network.isGrey() && view.channels == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
  const cv::Size size = network.inputSize(image.size());
  if (size.empty()) throw std::invalid_argument("an image of less than 8 pixels cannot be matched");
  if (size != image.size()) cv::resize(image, image, size, 0, 0, cv::INTER_AREA);
  return image;
}

class NetworkMatcher : public DenseMatcher {
 public:
  NetworkMatcher(const Network& network, const ImageView& query, const ImageMask& mask)
      : network_(network), mask_(mask), size_(query.width, query.height), input_(inputOf(network, query)) {
    mask.check(query.width, query.height);
  }

  std::vector<DenseMatch> match(const ImageView& reference, std::span<const Eigen::Vector2f> points) const override {
    const cv::Mat image = inputOf(network_, reference);
    const Warp warp = runOn(network_, {image, input_});
    const Eigen::Array2f cells(static_cast<float>(warp.x.cols), static_cast<float>(warp.x.rows));
    const Eigen::Array2f pixels_of_cell =
        Eigen::Array2f(static_cast<float>(reference.width), static_cast<float>(reference.height)) / cells;
    std::vector<DenseMatch> matches;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Array2f cell = (points[i].array() + 0.5f) / pixels_of_cell - 0.5f;  // 0: the centre of the first
      const auto pixel = placeAt(warp, cell.max(0).min(cells - 1), pixels_of_cell.maxCoeff());
      if (pixel && isVisible(*pixel)) matches.push_back({static_cast<int>(i), *pixel});
    }
    return matches;
  }

 private:
  Eigen::Vector2f pixelAt(const Warp& warp, int row, int column) const {
    return {warp.x.at<float>(row, column) * static_cast<float>(size_.width) - 0.5f,
            warp.y.at<float>(row, column) * static_cast<float>(size_.height) - 0.5f};
  }

  /// Between the four cells about it.
  std::optional<Eigen::Vector2f> placeAt(const Warp& warp, const Eigen::Array2f& cell, float cell_px) const {
    const int column = std::min(static_cast<int>(cell.x()), warp.x.cols - 2);
    const int row = std::min(static_cast<int>(cell.y()), warp.x.rows - 2);
    std::array<Eigen::Vector2f, 4> places;
    for (int i = 0; i < 4; ++i) {
      if (!(warp.confidence.at<float>(row + i / 2, column + i % 2) >= least_confidence)) return std::nullopt;
      places[static_cast<std::size_t>(i)] = pixelAt(warp, row + i / 2, column + i % 2);
    }
    for (const Eigen::Vector2f& place : places)
      if ((place - places[0]).norm() > most_stretched * std::numbers::sqrt2_v<float> * cell_px) return std::nullopt;
    const float right = cell.x() - static_cast<float>(column), down = cell.y() - static_cast<float>(row);
    return (1 - down) * ((1 - right) * places[0] + right * places[1]) +
           down * ((1 - right) * places[2] + right * places[3]);
  }

  bool isVisible(const Eigen::Vector2f& pixel) const {
    return pixel.x() >= -0.5f && pixel.y() >= -0.5f && pixel.x() < static_cast<float>(size_.width) - 0.5f &&
           pixel.y() < static_cast<float>(size_.height) - 0.5f && !mask_.hides(pixel);
  }

  const Network& network_;
  ImageMask mask_;
  cv::Size size_;
  cv::Mat input_;
};

}  // namespace

MatchNetwork::MatchNetwork(const std::string& file) {
  uint32_t any_checksum = 0;
  network_ = std::make_unique<Network>(file, any_checksum, 2);
  constexpr int most = 4096;  // sides of an image to look at
  const cv::Size size = network_->inputSize({320, 240});
  if (size.width > most || size.height > most) network_->refuse("its input is larger than 4096 x 4096");
  const cv::Mat grey(size, CV_8U, cv::Scalar(128));
  runOn(*network_, {grey, grey});  // its shape is seen by running
}

MatchNetwork::~MatchNetwork() = default;

std::unique_ptr<DenseMatcher> MatchNetwork::matcher(const ImageView& query, const ImageMask& mask) const {
  return std::make_unique<NetworkMatcher>(*network_, query, mask);
}

}  // namespace vmcl
