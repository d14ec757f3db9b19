// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "vmcl/vision/features.h"

namespace vmcl {

/// Whole-image descriptors from local features: the vector of locally aggregated descriptors (Jegou et al., CVPR 2010)
/// with intra-normalization and signed square root, over a vocabulary trained from the map itself.
class VladVocabulary {
 public:
  VladVocabulary() = default;

  /// Trains by seeded k-means on at most 50,000 descriptors of the given sets. Fewer descriptors than words: that many
  /// words. Throws std::invalid_argument when there are none or kinds differ.
  static VladVocabulary train(std::span<const FeatureSet* const> sets, int words = 64, uint64_t seed = 1);

  /// From stored words (one a row, in descriptor space as floats; ORB bits as -1/+1).
  VladVocabulary(FeatureKind kind, Eigen::MatrixXf words);

  FeatureKind kind() const { return kind_; }
  const Eigen::MatrixXf& words() const { return words_; }
  bool empty() const { return words_.size() == 0; }

  /// Unit vector of words * dimension entries; zero for an image without features.
  Eigen::VectorXf describe(const FeatureSet& features) const;

 private:
  FeatureKind kind_ = FeatureKind::orb;
  Eigen::MatrixXf words_;
};

/// A place and how alike it looks: the dot product of the descriptors, 1 = the same.
struct RetrievedPlace {
  int index = 0;
  float similarity = 0;
};

/// The `count` most similar columns of `places` (one descriptor a column), most similar first; ties by index.
std::vector<RetrievedPlace> retrieve(const Eigen::MatrixXf& places, const Eigen::VectorXf& query, int count);

}  // namespace vmcl
