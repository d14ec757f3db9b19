// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/instruction_sets.h"

// Compiled once for each instruction set; the best for the machine is chosen when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "place_index.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "vmcl/vision/place_index.h"

HWY_BEFORE_NAMESPACE();
namespace vmcl {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// The dot product of the signs of each place and the query: entries that neither lacks, less twice those that differ.
void multiplySigns(const uint64_t* place, const uint64_t* query, std::size_t words, std::vector<int64_t>& products) {
  const hn::ScalableTag<uint64_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  for (int64_t& product : products) {
    auto common = hn::Zero(tag), different = hn::Zero(tag);
    for (std::size_t k = 0; k < words; k += lanes) {
      const auto both = hn::And(hn::LoadU(tag, place + k), hn::LoadU(tag, query + k));
      const auto signs = hn::Xor(hn::LoadU(tag, place + words + k), hn::LoadU(tag, query + words + k));
      common = common + hn::PopulationCount(both);
      different = different + hn::PopulationCount(hn::And(both, signs));
    }
    product = static_cast<int64_t>(hn::GetLane(hn::SumOfLanes(tag, common))) -
              2 * static_cast<int64_t>(hn::GetLane(hn::SumOfLanes(tag, different)));
    place += 2 * words;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vmcl {
namespace {

HWY_EXPORT(multiplySigns);

constexpr std::size_t widest_vector = 32;  // words, more than any instruction set has

std::size_t wordCount(Eigen::Index entries) {
  return (static_cast<std::size_t>(entries) + 64 * widest_vector - 1) / (64 * widest_vector) * widest_vector;
}

/// Words of the bits of entries that are not 0, then as many of those that are positive.
std::vector<uint64_t> signsOf(const Eigen::Ref<const Eigen::VectorXf>& descriptor) {
  const std::size_t words = wordCount(descriptor.size());
  std::vector<uint64_t> bits(2 * words);
  for (Eigen::Index i = 0; i < descriptor.size(); ++i) {
    const std::size_t word = static_cast<std::size_t>(i / 64);
    const uint64_t bit = uint64_t{1} << i % 64;
    if (descriptor[i] != 0) bits[word] |= bit;
    if (descriptor[i] > 0) bits[words + word] |= bit;
  }
  return bits;
}

}  // namespace

PlaceIndex::PlaceIndex(const Eigen::MatrixXf& places) : places_(places) {
  if (places.cols() <= shortlist) return;
  signs_.reserve(2 * wordCount(places.rows()) * static_cast<std::size_t>(places.cols()));
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const std::vector<uint64_t> signs = signsOf(places.col(i));
    signs_.insert(signs_.end(), signs.begin(), signs.end());
    norms_.push_back(std::sqrt(static_cast<float>(std::max<Eigen::Index>(1, (places.col(i).array() != 0).count()))));
  }
}

std::vector<RetrievedPlace> PlaceIndex::retrieve(const Eigen::VectorXf& query, int count) const {
  if (norms_.empty() || count > shortlist) return vmcl::retrieve(places_, query, count);
  if (query.size() != places_.rows())
    throw std::invalid_argument("place descriptors have " + std::to_string(places_.rows()) + " entries, the query " +
                                std::to_string(query.size()));
  std::vector<int64_t> products(norms_.size());
  HWY_DYNAMIC_DISPATCH(multiplySigns)
  (signs_.data(), signsOf(query).data(), wordCount(query.size()), products);
  std::vector<RetrievedPlace> places;
  for (std::size_t i = 0; i < products.size(); ++i)
    places.push_back({static_cast<int>(i), static_cast<float>(products[i]) / norms_[i]});
  const auto is_more_alike = [](const RetrievedPlace& a, const RetrievedPlace& b) {
    return a.similarity != b.similarity ? a.similarity > b.similarity : a.index < b.index;
  };
  std::ranges::nth_element(places, places.begin() + shortlist, is_more_alike);
  places.resize(shortlist);
  for (RetrievedPlace& place : places) place.similarity = places_.col(place.index).dot(query);
  std::ranges::sort(places, is_more_alike);
  places.resize(static_cast<std::size_t>(std::max(count, 0)));
  return places;
}

}  // namespace vmcl
#endif
