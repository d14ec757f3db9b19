// SPDX-License-Identifier: BSD-3-Clause
// Brute force, a reference descriptor a lane. Entries of vectors are bytes, at most 256 about 128: the sums of
// their products stay below 2^24, so that single precision is exact.

#include "vmcl/geometry/instruction_sets.h"

// Compiled once for each instruction set, that of every machine of its kind included; the best for the machine is
// chosen when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nearest_descriptors.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "nearest_descriptors.h"

HWY_BEFORE_NAMESPACE();
namespace vmcl {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using IntTag = hn::CappedTag<int32_t, DescriptorBlocks::block>;
using WordTag = hn::RebindToUnsigned<IntTag>;
using FloatTag = hn::RebindToFloat<IntTag>;
using Int = hn::Vec<IntTag>;
using Word = hn::Vec<WordTag>;
using Float = hn::Vec<FloatTag>;

constexpr std::size_t lanes = hn::MaxLanes(IntTag());

/// Bits that differ are counted by adding up neighbours within words (Warren, Hacker's Delight, section 5-1).
class Hamming {
 public:
  using Element = uint32_t;
  using Sum = Word;

  explicit Hamming(const DescriptorBlocks& blocks) : references_(blocks.bits.data()) {}

  const uint32_t* references() const { return references_; }

  static HWY_INLINE Word read(const uint32_t* from) { return hn::LoadU(WordTag(), from); }
  static HWY_INLINE Word zero() { return hn::Zero(WordTag()); }

  static HWY_INLINE Word add(Word sums, uint32_t query, Word reference) {
    const auto all = [](uint32_t value) HWY_ATTR { return hn::Set(WordTag(), value); };
    Word bits = all(query) ^ reference;
    bits = bits - (hn::ShiftRight<1>(bits) & all(0x55555555u));
    bits = (bits & all(0x33333333u)) + (hn::ShiftRight<2>(bits) & all(0x33333333u));
    return sums + ((bits + hn::ShiftRight<4>(bits)) & all(0x0f0f0f0fu));  // bytes stay below 256 for up to 31 words
  }

  float squaredNorm(const uint32_t*) const { return 0; }  // of no use here

  HWY_INLINE Int distances(Word sums, float, std::size_t) const {
    const Word bytes = hn::Set(WordTag(), 0x00ff00ffu), low = hn::Set(WordTag(), 0xffffu);
    sums = (sums & bytes) + (hn::ShiftRight<8>(sums) & bytes);
    return hn::BitCast(IntTag(), (sums & low) + hn::ShiftRight<16>(sums));
  }

 private:
  const uint32_t* references_;
};

class SquaredEuclidean {
 public:
  using Element = float;
  using Sum = Float;

  explicit SquaredEuclidean(const DescriptorBlocks& blocks)
      : references_(blocks.entries.data()), squared_norms_(blocks.squared_norms.data()), words_(blocks.words) {}

  const float* references() const { return references_; }

  static HWY_INLINE Float read(const float* from) { return hn::LoadU(FloatTag(), from); }
  static HWY_INLINE Float zero() { return hn::Zero(FloatTag()); }

  static HWY_INLINE Float add(Float sum, float query, Float reference) {
    return hn::MulAdd(hn::Set(FloatTag(), query), reference, sum);
  }

  float squaredNorm(const float* query) const {
    float sum = 0;
    for (std::size_t k = 0; k < words_; ++k) sum += query[k] * query[k];
    return sum;
  }

  HWY_INLINE Int distances(Float products, float squared_norm, std::size_t first_row) const {
    const Float norms = hn::Set(FloatTag(), squared_norm) + hn::LoadU(FloatTag(), squared_norms_ + first_row);
    return hn::ConvertTo(IntTag(), norms - (products + products));
  }

 private:
  const float* references_;
  const float* squared_norms_;
  std::size_t words_;
};

/// The nearest so far of every so many references, beginning with each lane's.
class NearestLanes {
 public:
  NearestLanes()  // not by default, which would be compiled for the common instruction set
      : rows_(hn::Set(IntTag(), -1)), nearest_(hn::Set(IntTag(), no_distance)), second_(nearest_) {}

  HWY_INLINE void offer(Int rows, Int distances) {
    second_ = hn::Min(second_, hn::Max(nearest_, distances));
    rows_ = hn::IfThenElse(distances < nearest_, rows, rows_);
    nearest_ = hn::Min(nearest_, distances);
  }

  Nearest overall() const {
    int32_t rows[lanes], nearest[lanes], second[lanes];
    hn::StoreU(rows_, IntTag(), rows);
    hn::StoreU(nearest_, IntTag(), nearest);
    hn::StoreU(second_, IntTag(), second);
    Nearest best;
    for (std::size_t i = 0; i < lanes; ++i) {
      if (nearest[i] == no_distance) continue;
      if (std::tie(nearest[i], rows[i]) < std::tie(best.distance, best.row)) {
        best.second_distance = std::min(second[i], best.distance);
        best.distance = nearest[i];
        best.row = rows[i];
      } else {
        best.second_distance = std::min(best.second_distance, nearest[i]);
      }
    }
    return best;
  }

 private:
  Int rows_, nearest_, second_;
};

template <class Distance>
void search(const DescriptorBlocks& blocks, const typename Distance::Element* const* queries, Nearest* nearest) {
  const Distance distance(blocks);
  NearestLanes found[queries_abreast];
  float squared_norms[queries_abreast];
  for (std::size_t q = 0; q < queries_abreast; ++q) squared_norms[q] = distance.squaredNorm(queries[q]);
  const Int count = hn::Set(IntTag(), static_cast<int32_t>(blocks.count)), none = hn::Set(IntTag(), no_distance);
  for (std::size_t row = 0; row < blocks.count; row += lanes) {
    const std::size_t block = row / DescriptorBlocks::block, lane = row % DescriptorBlocks::block;
    const auto* references = distance.references() + block * blocks.words * DescriptorBlocks::block + lane;
    typename Distance::Sum sums[queries_abreast];
    for (auto& sum : sums) sum = Distance::zero();
    for (std::size_t k = 0; k < blocks.words; ++k) {
      const auto reference = Distance::read(references + k * DescriptorBlocks::block);
      for (std::size_t q = 0; q < queries_abreast; ++q) sums[q] = Distance::add(sums[q], queries[q][k], reference);
    }
    const Int rows = hn::Iota(IntTag(), static_cast<int32_t>(row));
    for (std::size_t q = 0; q < queries_abreast; ++q)
      found[q].offer(rows, hn::IfThenElse(rows < count, distance.distances(sums[q], squared_norms[q], row), none));
  }
  for (std::size_t q = 0; q < queries_abreast; ++q) nearest[q] = found[q].overall();
}

void searchBits(const DescriptorBlocks& blocks, const uint32_t* const* queries, Nearest* nearest) {
  search<Hamming>(blocks, queries, nearest);
}

void searchEntries(const DescriptorBlocks& blocks, const float* const* queries, Nearest* nearest) {
  search<SquaredEuclidean>(blocks, queries, nearest);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace vmcl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vmcl {
namespace {

/// The words of one descriptor.
void readWords(const uint8_t* descriptor, std::span<uint32_t> words) {
  std::memcpy(words.data(), descriptor, words.size_bytes());
}

void readWords(const uint8_t* descriptor, std::span<float> words) {
  std::copy_n(descriptor, words.size(), words.begin());
}

/// Searches for as many queries at a time; the last is repeated where there are fewer.
template <class Element, class Search>
std::vector<Nearest> searchAll(const DescriptorBlocks& blocks, const Descriptors& queries, std::span<const int> rows,
                               Search&& search) {
  std::vector<Nearest> nearest(rows.size());
  std::vector<Element> words(queries_abreast * blocks.words);
  for (std::size_t first = 0; first < rows.size(); first += queries_abreast) {
    const Element* starts[queries_abreast];
    Nearest found[queries_abreast];
    for (std::size_t q = 0; q < queries_abreast; ++q) {
      const auto own = std::span(words).subspan(q * blocks.words, blocks.words);
      readWords(queries.row(rows[std::min(first + q, rows.size() - 1)]).data(), own);
      starts[q] = own.data();
    }
    search(starts, found);
    std::copy_n(found, std::min(queries_abreast, rows.size() - first),
                nearest.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return nearest;
}

template <class Element>
std::vector<Element> inBlocks(const Descriptors& descriptors, std::size_t words) {
  constexpr std::size_t block = DescriptorBlocks::block;
  const auto count = static_cast<std::size_t>(descriptors.rows());
  std::vector<Element> blocks((count + block - 1) / block * block * words), descriptor(words);
  for (std::size_t row = 0; row < count; ++row) {
    readWords(descriptors.row(static_cast<Eigen::Index>(row)).data(), descriptor);
    for (std::size_t k = 0; k < words; ++k) blocks[(row / block * words + k) * block + row % block] = descriptor[k];
  }
  return blocks;
}

HWY_EXPORT(searchBits);
HWY_EXPORT(searchEntries);

}  // namespace

DescriptorBlocks::DescriptorBlocks(FeatureKind kind_of_all, const Descriptors& descriptors)
    : kind(kind_of_all), count(static_cast<std::size_t>(descriptors.rows())) {
  const auto bytes = static_cast<std::size_t>(descriptors.cols());
  if (isBinary(kind)) {
    words = bytes / sizeof(uint32_t);
    bits = inBlocks<uint32_t>(descriptors, words);
    return;
  }
  words = bytes;
  entries = inBlocks<float>(descriptors, words);
  squared_norms.resize((count + block - 1) / block * block);
  Eigen::VectorXf::Map(squared_norms.data(), descriptors.rows()) = descriptors.cast<float>().rowwise().squaredNorm();
}

std::vector<Nearest> nearestAmong(const DescriptorBlocks& blocks, const Descriptors& queries,
                                  std::span<const int> rows) {
  if (isBinary(blocks.kind))
    return searchAll<uint32_t>(blocks, queries, rows, [&](const uint32_t* const* words, Nearest* nearest) {
      HWY_DYNAMIC_DISPATCH(searchBits)(blocks, words, nearest);
    });
  return searchAll<float>(blocks, queries, rows, [&](const float* const* words, Nearest* nearest) {
    HWY_DYNAMIC_DISPATCH(searchEntries)(blocks, words, nearest);
  });
}

}  // namespace vmcl
#endif
