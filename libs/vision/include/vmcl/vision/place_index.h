// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "vmcl/vision/place_recognition.h"

namespace vmcl {

/// VLAD descriptors of the places of a map, for searches among many: the `shortlist` that are most alike by the signs
/// of their entries alone (-1, 0, 1) are compared in full. Searches among fewer are exact. It takes two bits an entry.
class PlaceIndex {
 public:
  static constexpr int shortlist = 1000;

  /// The places (one a column) are kept by reference and must outlive the index.
  explicit PlaceIndex(const Eigen::MatrixXf& places);
  explicit PlaceIndex(Eigen::MatrixXf&&) = delete;

  /// As retrieve(). Thread safe.
  std::vector<RetrievedPlace> retrieve(const Eigen::VectorXf& query, int count) const;

 private:
  const Eigen::MatrixXf& places_;
  std::vector<uint64_t> signs_;  ///< place by place: bits of the entries that are not 0, then of the positive ones
  std::vector<float> norms_;     ///< of a place's signs; empty: searches are exact
};

}  // namespace vmcl
