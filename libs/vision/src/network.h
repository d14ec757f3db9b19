// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <opencv2/dnn.hpp>
#include <span>
#include <string>
#include <vector>

namespace vmcl {

/// A neural network of an ONNX file whose inputs are images: 1 x channels x height x width, grey or RGB, [0, 1].
/// Thread safe, one run at a time.
class Network {
 public:
  /// `crc32` is that of the file; 0 is replaced by it. Throws std::runtime_error naming the file: missing, no ONNX file
  /// or cut off, another checksum, or other inputs than so many images.
  Network(const std::string& file, uint32_t& crc32, std::size_t images);

  /// Size that the network wants its images in: one of its own, or any, up to what a multiple of 8 leaves over.
  cv::Size inputSize(cv::Size image) const;

  /// Whether its images have one channel.
  bool isGrey() const { return channels_ == 1; }

  /// Runs on images of size inputSize(), grey or, if the network takes colours, BGR. Throws std::runtime_error naming
  /// the file when that fails or an output is not finite.
  std::vector<cv::Mat> run(std::span<const cv::Mat> images) const;

  /// To be thrown when the outputs are not what they should be.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  std::string file_;
  std::vector<std::string> input_names_;
  int channels_ = 1;
  cv::Size fixed_size_;  ///< 0 x 0: any
  mutable std::mutex mutex_;
  mutable cv::dnn::Net net_;
  std::vector<cv::String> output_names_;
};

}  // namespace vmcl
