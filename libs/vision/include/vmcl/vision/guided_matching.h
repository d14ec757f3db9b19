// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vmcl/vision/feature_matching.h"

namespace vmcl {

/// Where the query image should show what a feature of the reference shows: normal about a pixel.
struct ExpectedFeature {
  int reference = 0;  ///< row
  Eigen::Vector2d query_pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< pixels^2
};

/// The features of the query nearest to the expected ones by descriptor, of those within the 99.7 % ellipse of where
/// they are expected; by increasing query row. The ratio test compares with all other features there and within some 50
/// pixels, as few are; a query feature that several name is kept by the nearest. Rows of the reference may be expected
/// repeatedly. Throws std::invalid_argument when the kinds differ, a row is out of range or a covariance not positive
/// definite.
std::vector<FeatureMatch> matchExpected(const FeatureSet& query, const FeatureSet& reference,
                                        std::span<const ExpectedFeature> expected, const MatchingOptions& options);

}  // namespace vmcl
