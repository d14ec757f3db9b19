// SPDX-License-Identifier: BSD-3-Clause
// The outputs of a network of features, told apart by their shapes (doc/features.md):
//   1 x 65 x h x w  detector of SuperPoint (DeTone et al. 2018): logits of the 8 x 8 pixels of a cell and of "none"
//   1 x 1 x h x w   a factor of the score, [0, 1]: heat map, repeatability, reliability
//   1 x d x h x w   descriptors, d up to 256, of any length
// over the whole image each.

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "feature_detector.h"
#include "network.h"

namespace vmcl {
namespace {

constexpr int cell = 8;  // pixels
constexpr int cell_logits = cell * cell + 1;
constexpr int peak_radius = 2;                   // pixels of the network's image
constexpr float min_score = 1.0f / cell_logits;  // what a cell that shows nothing gives each of its pixels

/// A value along the third and fourth dimension of an output.
cv::Mat channel(const cv::Mat& output, int index) {
  return {output.size[2], output.size[3], CV_32F, const_cast<float*>(output.ptr<float>(0, index))};
}

cv::Mat scoresOfCells(const cv::Mat& logits) {
  const int rows = logits.size[2], columns = logits.size[3];
  cv::Mat scores(cell * rows, cell * columns, CV_32F);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      float values[cell_logits], sum = 0;
      for (int k = 0; k < cell_logits; ++k) values[k] = logits.ptr<float>(0, k, row)[column];
      const float largest = *std::max_element(values, values + cell_logits);
      for (float& value : values) sum += value = std::exp(value - largest);
      for (int k = 0; k < cell * cell; ++k)
        scores.at<float>(cell * row + k / cell, cell * column + k % cell) = values[k] / sum;
    }
  return scores;
}

/// Where between its neighbours the peak of a parabola lies, [-1/2, 1/2].
float peakOffset(float before, float at, float after) {
  const float bend = before - 2 * at + after;
  return bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5f, 0.5f) : 0;
}

class NetworkDetector : public FeatureDetector {
 public:
  NetworkDetector(FeatureModel& model, int max_features)
      : network_(model.file, model.crc32, 1), max_features_(max_features) {
    // What the outputs are is seen by running.
    descriptor_bytes_ = outputsOf(cv::Mat(network_.inputSize({64, 64}), CV_8U, cv::Scalar(128))).descriptors.size[1];
  }

  int descriptorBytes() const override { return descriptor_bytes_; }

  DetectedFeatures detect(const cv::Mat& grey) const override {
    DetectedFeatures found;
    found.descriptors.resize(0, descriptor_bytes_);
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(grey, &darkest, &brightest);
    if (darkest == brightest) return found;  // networks see something everywhere
    const cv::Size size = network_.inputSize(grey.size());
    const bool is_resized = size.width > grey.cols || size.height > grey.rows || size.width <= grey.cols - cell ||
                            size.height <= grey.rows - cell;
    cv::Mat seen = grey(cv::Rect({}, is_resized ? grey.size() : size));
    const cv::Point2f scale(static_cast<float>(seen.cols) / static_cast<float>(size.width),
                            static_cast<float>(seen.rows) / static_cast<float>(size.height));
    if (is_resized) cv::resize(seen, seen, size, 0, 0, cv::INTER_AREA);

    const Outputs outputs = outputsOf(seen);
    found.keypoints = peaks(outputs.scores);
    found.descriptors.resize(static_cast<Eigen::Index>(found.keypoints.size()), descriptor_bytes_);
    for (std::size_t i = 0; i < found.keypoints.size(); ++i) {
      cv::KeyPoint& keypoint = found.keypoints[i];
      describe(outputs.descriptors, keypoint.pt, size, found.descriptors.row(static_cast<Eigen::Index>(i)).data());
      keypoint.pt = {(keypoint.pt.x + 0.5f) * scale.x - 0.5f, (keypoint.pt.y + 0.5f) * scale.y - 0.5f};
      keypoint.size *= std::max(scale.x, scale.y);
    }
    return found;
  }

 private:
  struct Outputs {
    cv::Mat scores;       ///< of each pixel
    cv::Mat descriptors;  ///< 1 x d x h x w
  };

  Outputs outputsOf(const cv::Mat& image) const {
    Outputs outputs;
    outputs.scores = cv::Mat(image.size(), CV_32F, cv::Scalar(1));
    bool has_scores = false;
    for (const cv::Mat& output : network_.run({&image, 1})) {
      if (output.dims != 4 || output.size[0] != 1) network_.refuse("an output is not of 1 x channels x height x width");
      const int channels = output.size[1];
      if (channels == 1 || channels == cell_logits) {
        cv::Mat scores = channels == 1 ? channel(output, 0) : scoresOfCells(output);
        cv::resize(scores, scores, image.size(), 0, 0, cv::INTER_LINEAR);
        outputs.scores = outputs.scores.mul(scores);
        has_scores = true;
      } else if (channels >= 16 && channels <= max_descriptor_bytes && outputs.descriptors.empty()) {
        outputs.descriptors = output;
      } else {
        network_.refuse("an output of " + std::to_string(channels) + " channels is neither scores nor descriptors");
      }
    }
    if (!has_scores || outputs.descriptors.empty()) network_.refuse("no output of scores, or none of descriptors");
    return outputs;
  }

  std::vector<cv::KeyPoint> peaks(const cv::Mat& scores) const {
    cv::Mat largest;
    cv::dilate(scores, largest, cv::Mat::ones(2 * peak_radius + 1, 2 * peak_radius + 1, CV_8U));
    std::vector<cv::KeyPoint> keypoints;
    for (int y = peak_radius; y < scores.rows - peak_radius; ++y)
      for (int x = peak_radius; x < scores.cols - peak_radius; ++x) {
        const float score = scores.at<float>(y, x);
        if (score < largest.at<float>(y, x) || score <= min_score) continue;
        const float dx = peakOffset(scores.at<float>(y, x - 1), score, scores.at<float>(y, x + 1));
        const float dy = peakOffset(scores.at<float>(y - 1, x), score, scores.at<float>(y + 1, x));
        keypoints.emplace_back(static_cast<float>(x) + dx, static_cast<float>(y) + dy, static_cast<float>(cell), -1.0f,
                               score);
      }
    cv::KeyPointsFilter::retainBest(keypoints, max_features_);
    return keypoints;
  }

  /// Interpolates the unit vectors about a pixel of an image of `size`, normalizes, and rounds to bytes.
  static void describe(const cv::Mat& maps, cv::Point2f pixel, cv::Size size, uint8_t* descriptor) {
    const int channels = maps.size[1], rows = maps.size[2], columns = maps.size[3];
    const float u = std::clamp((pixel.x + 0.5f) * static_cast<float>(columns) / static_cast<float>(size.width) - 0.5f,
                               0.0f, static_cast<float>(columns - 1));
    const float v = std::clamp((pixel.y + 0.5f) * static_cast<float>(rows) / static_cast<float>(size.height) - 0.5f,
                               0.0f, static_cast<float>(rows - 1));
    const int left = static_cast<int>(u), top = static_cast<int>(v);
    Eigen::VectorXf sum = Eigen::VectorXf::Zero(channels), corner(channels);
    for (int i = 0; i < 4; ++i) {
      const int column = std::min(left + i % 2, columns - 1), row = std::min(top + i / 2, rows - 1);
      const float du = u - static_cast<float>(left), dv = v - static_cast<float>(top);
      for (int k = 0; k < channels; ++k) corner[k] = maps.ptr<float>(0, k, row)[column];
      sum += (i % 2 ? du : 1 - du) * (i / 2 ? dv : 1 - dv) * corner.normalized();
    }
    sum.normalize();
    for (int k = 0; k < channels; ++k)
      descriptor[k] = static_cast<uint8_t>(std::clamp(128 + std::round(256 * sum[k]), 0.0f, 255.0f));
  }

  Network network_;
  int max_features_;
  int descriptor_bytes_ = 0;
};

}  // namespace

std::unique_ptr<FeatureDetector> networkDetector(FeatureModel& model, int max_features) {
  return std::make_unique<NetworkDetector>(model, max_features);
}

}  // namespace vmcl
