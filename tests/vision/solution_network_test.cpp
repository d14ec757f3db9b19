// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/solution_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "scratch_directory.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string compact = std::string(VMCL_SOURCE_DIR) + "/share/selector/compact.onnx";

TEST(SolutionNetworkTest, TellsByTheHeatMap) {
  const SolutionNetwork network(compact);
  ColourImage image{network.width(), network.height(), {}};
  image.pixels.assign(static_cast<std::size_t>(3 * image.width * image.height), 0);
  const auto black = network(image.view());
  EXPECT_TRUE(std::isfinite(black[0]) && std::isfinite(black[1]));
  EXPECT_EQ(network(image.view()), black);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) image.pixels[i] = 90;
  EXPECT_NE(network(image.view()), black);
  EXPECT_THROW(network(ColourImage{8, 8, std::vector<uint8_t>(192)}.view()), std::invalid_argument);
}

TEST(SolutionNetworkTest, RefusesAFileThatIsAbsentOrCutOff) {
  const ScratchDirectory scratch;
  const std::string file = (scratch.path() / "cut.onnx").string();
  EXPECT_THAT([&] { SolutionNetwork{file}; }, ThrowsMessage<std::runtime_error>(HasSubstr("cannot be opened")));
  std::ifstream in(compact, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (const std::size_t length : {std::size_t{0}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    std::ofstream(file, std::ios::binary) << bytes.substr(0, length);
    EXPECT_THAT([&] { SolutionNetwork{file}; }, ThrowsMessage<std::runtime_error>(HasSubstr("cut.onnx"))) << length;
  }
}

TEST(SolutionNetworkTest, RefusesANetworkOfAnotherShape) {
  const std::string models = std::string(VMCL_SHARED_DIR) + "/models/";
  if (!std::filesystem::exists(models)) GTEST_SKIP() << models << " is not here";
  for (const auto& [file, reason] : {std::pair{"superpoint_mbv1.onnx", "no fixed size"}, {"xfeat_320x224.onnx", "two"}})
    EXPECT_THAT([&] { SolutionNetwork{models + file}; },
                ThrowsMessage<std::runtime_error>(testing::AllOf(HasSubstr(file), HasSubstr(reason))));
}

}  // namespace
}  // namespace vmcl
