// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vmcl/evaluation/trajectory_error.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {

/// What became of one image.
struct ImageResult {
  double time = 0;      ///< s
  std::string label{};  ///< of the camera
  std::size_t matches = 0;
  PoseEstimate estimate{};
  RelocalizationTimes times{};
  bool has_truth = false;                         ///< the ground truth covers the time
  std::optional<PoseError> error = {};            ///< where a pose was found and the truth is known
  std::vector<std::pair<int, int>> references{};  ///< keyframes, and matches with each
  std::vector<std::pair<std::string, std::optional<PoseError>>> peers{};  ///< other methods' errors, by name
};

/// How many images were found, how well, and how fast.
void printTable(std::span<const ImageResult> results);

/// A line an image: time, camera, status, x, y, phi, covariance, modes, inliers, matches, errors, references; m, rad,
/// s.
void writeResults(const std::filesystem::path& file, std::span<const ImageResult> results);

/// A line an image and peer: time, camera, method, errors (empty: no pose found); m, rad.
void writePeers(const std::filesystem::path& file, std::span<const ImageResult> results);

/// The seconds that each step took. Apart, because they differ from run to run where the others do not.
void writeTiming(const std::filesystem::path& file, std::span<const ImageResult> results);

}  // namespace vmcl
