// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/solution_network.h"

#include <stdexcept>

#include "network.h"

namespace vmcl {
namespace {

cv::Size sizeOf(const Network& network) {
  const cv::Size size = network.inputSize({8, 8});
  if (size != network.inputSize({16, 16})) network.refuse("its input has no fixed size");
  constexpr int most = 2048;  // sides of what is kept for it
  if (size.width > most || size.height > most) network.refuse("its input is larger than 2048 x 2048");
  return size;
}

}  // namespace

SolutionNetwork::SolutionNetwork(const std::string& file) {
  uint32_t any_checksum = 0;
  network_ = std::make_unique<Network>(file, any_checksum, 1);
  const ColourImage blank{sizeOf(*network_).width, sizeOf(*network_).height,
                          std::vector<uint8_t>(3 * static_cast<std::size_t>(sizeOf(*network_).area()))};
  (*this)(blank.view());  // what the outputs are is seen by running
}

SolutionNetwork::~SolutionNetwork() = default;
SolutionNetwork::SolutionNetwork(SolutionNetwork&&) noexcept = default;

int SolutionNetwork::width() const { return sizeOf(*network_).width; }
int SolutionNetwork::height() const { return sizeOf(*network_).height; }

std::array<float, 2> SolutionNetwork::operator()(const ImageView& heat_map) const {
  if (heat_map.width != width() || heat_map.height != height() || heat_map.channels != 3)
    throw std::invalid_argument("heat map of another size than the network's " + std::to_string(width()) + " x " +
                                std::to_string(height()));
  const cv::Mat image(heat_map.height, heat_map.width, CV_8UC3, const_cast<uint8_t*>(heat_map.pixels),
                      heat_map.row_bytes);
  const std::vector<cv::Mat> outputs = network_->run(std::span(&image, 1));
  if (outputs.size() != 1 || outputs.front().total() != 2) network_->refuse("it has other outputs than two numbers");
  return {outputs.front().ptr<float>()[0], outputs.front().ptr<float>()[1]};
}

}  // namespace vmcl
