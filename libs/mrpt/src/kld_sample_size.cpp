// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/kld_sample_size.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/distributions.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "option_range.h"

namespace vmcl {
namespace {

long binOf(double coordinate, double size) {
  constexpr double last = 0x1p53;  // farther bins fit into no long
  return std::lround(std::clamp(coordinate / size, -last, last));
}

}  // namespace

KldSampleSize::KldSampleSize(const mrpt::slam::TKLDParams& options)
    : options_(options), needed_(options.KLD_minSampleSize) {
  const auto demandSize = [](const char* key, std::size_t size, std::size_t least) {
    demand(size >= least && size <= most_particles, key, size,
           "in [" + std::to_string(least) + ", " + std::to_string(most_particles) + "]");
  };
  const auto demandPart = [](const char* key, double part) { demand(part > 0 && part < 1, key, part, "in (0, 1)"); };
  demandSize("KLD_minSampleSize", options.KLD_minSampleSize, 1);
  demandSize("KLD_maxSampleSize", options.KLD_maxSampleSize, options.KLD_minSampleSize);
  demandPositive("KLD_binSize_XY", options.KLD_binSize_XY);
  demandPositive("KLD_binSize_PHI_deg", mrpt::RAD2DEG(options.KLD_binSize_PHI));
  demandPart("KLD_delta", options.KLD_delta);
  demandPart("KLD_epsilon", options.KLD_epsilon);
  quantile_ = mrpt::math::normalQuantile(1 - options.KLD_delta);
}

/// By the Wilson-Hilferty approximation of the chi-square quantile (eq. 7 of the paper).
std::size_t KldSampleSize::needed(std::size_t bins) const {
  const std::size_t least = options_.KLD_minSampleSize, most = options_.KLD_maxSampleSize;
  if (bins < 2) return least;
  const double freedom = static_cast<double>(bins - 1), part = 2 / (9 * freedom);
  const double quantile = freedom * std::pow(1 - part + std::sqrt(part) * quantile_, 3);
  const double count = std::ceil(quantile / (2 * options_.KLD_epsilon));
  return static_cast<std::size_t>(std::clamp(count, static_cast<double>(least), static_cast<double>(most)));
}

std::size_t KldSampleSize::add(const PlanarPose& pose) {
  const double size = options_.KLD_binSize_XY;
  if (bins_.insert({binOf(pose.x, size), binOf(pose.y, size), binOf(wrapAngle(pose.phi), options_.KLD_binSize_PHI)})
          .second)
    needed_ = needed(bins_.size());
  return needed_;
}

}  // namespace vmcl
