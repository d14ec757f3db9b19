// SPDX-License-Identifier: BSD-3-Clause
#include "network.h"

#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "onnx_inputs.h"

namespace vmcl {
namespace {

constexpr std::uintmax_t max_model_bytes = 1'000'000'000;

/// While it lives OpenCV does not print what it throws anyway.
class QuietOpenCv {
 public:
  QuietOpenCv() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(before_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

std::string readModel(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file)) throw std::runtime_error("cannot be opened");
  const std::uintmax_t size = std::filesystem::file_size(file);
  if (size > max_model_bytes) throw std::runtime_error("larger than any model of 1 GB");
  std::string bytes(size, '\0');
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) throw std::runtime_error("cannot be read");
  return bytes;
}

std::string inHex(uint32_t number) {
  std::ostringstream text;
  text << std::hex << number;
  return text.str();
}

}  // namespace

Network::Network(const std::string& file, uint32_t& crc32, std::size_t images) try : file_(file) {
  const std::string bytes = readModel(file);
  const auto checksum = static_cast<uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  if (crc32 != 0 && crc32 != checksum)
    throw std::runtime_error("checksum " + inHex(checksum) + ", the map was made with a model of " + inHex(crc32));
  const std::vector<OnnxInput> inputs = onnxInputs(bytes);
  if (inputs.size() != images)
    throw std::runtime_error(std::to_string(inputs.size()) + " inputs, not " + std::to_string(images));
  for (const OnnxInput& input : inputs) {
    const auto& shape = input.dimensions;
    if (shape.size() != 4 || shape[0] > 1 || (shape[1] != 1 && shape[1] != 3) || shape[2] > 1 << 16 ||
        shape[3] > 1 << 16 || (shape[2] == 0) != (shape[3] == 0) || shape != inputs.front().dimensions)
      throw std::runtime_error("input '" + input.name + "' is no image of 1 x (1 or 3) x height x width");
    input_names_.push_back(input.name);
    channels_ = static_cast<int>(shape[1]);
    fixed_size_ = cv::Size(static_cast<int>(shape[3]), static_cast<int>(shape[2]));
  }
  const QuietOpenCv quiet;
  net_ = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  output_names_ = net_.getUnconnectedOutLayersNames();
  crc32 = checksum;
} catch (const cv::Exception& error) {
  throw std::runtime_error(file + ": OpenCV cannot use this model: " + error.err);
} catch (const std::exception& error) {
  throw std::runtime_error(file + ": " + error.what());
}

cv::Size Network::inputSize(cv::Size image) const {
  return fixed_size_.empty() ? cv::Size(image.width / 8 * 8, image.height / 8 * 8) : fixed_size_;
}

std::vector<cv::Mat> Network::run(std::span<const cv::Mat> images) const try {
  const std::scoped_lock lock(mutex_);
  const QuietOpenCv quiet;
  for (std::size_t i = 0; i < images.size(); ++i) {
    cv::Mat image = images[i];
    if (channels_ == 3 && image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
    if (image.channels() != channels_)
      throw std::runtime_error("its input has one channel, not those of a colour image");
    constexpr bool from_bgr_to_rgb = true;
    net_.setInput(cv::dnn::blobFromImage(image, 1 / 255.0, {}, {}, from_bgr_to_rgb), input_names_[i]);
  }
  std::vector<cv::Mat> outputs;
  net_.forward(outputs, output_names_);
  for (cv::Mat& output : outputs) {
    output = output.clone();  // the network writes to the same memory again
    if (output.type() != CV_32F || !cv::checkRange(output)) throw std::runtime_error("an output is not finite");
  }
  return outputs;
} catch (const cv::Exception& error) {
  refuse("OpenCV cannot run this model on an image of " + std::to_string(images[0].cols) + " x " +
         std::to_string(images[0].rows) + " pixels: " + error.err);
} catch (const std::runtime_error& error) {
  refuse(error.what());
}

void Network::refuse(const std::string& reason) const { throw std::runtime_error(file_ + ": " + reason); }

}  // namespace vmcl
