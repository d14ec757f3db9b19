// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vmcl/vision/features.h"

namespace vmcl {

inline constexpr int32_t no_distance = std::numeric_limits<int32_t>::max();

inline constexpr std::size_t queries_abreast = 4;  ///< that share the reading of the references

/// The nearest descriptor, the first of those as near, and how near the second nearest is.
struct Nearest {
  int row = -1;
  int32_t distance = no_distance;
  int32_t second_distance = no_distance;
};

/// Descriptors laid out for searches among them.
struct DescriptorBlocks {
  static constexpr std::size_t block = 16;  ///< descriptors side by side: at least the lanes of a vector

  FeatureKind kind = FeatureKind::orb;
  std::size_t count = 0;
  std::size_t words = 0;  ///< of a descriptor: 32 bits, or an entry as float
  /// First words of a block, second words of it, and so on; then the next block. The last one is filled up with zeros.
  std::vector<uint32_t> bits;
  std::vector<float> entries;
  std::vector<float> squared_norms;  ///< of vectors

  DescriptorBlocks(FeatureKind kind, const Descriptors& descriptors);
};

/// The nearest of the blocks to each of the rows of the queries, by Hamming or squared Euclidean distance, as the
/// kind has it. Exact, and the same on every machine.
std::vector<Nearest> nearestAmong(const DescriptorBlocks& blocks, const Descriptors& queries,
                                  std::span<const int> rows);

}  // namespace vmcl
