// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/place_recognition.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

/// One sample or word a row.
using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr Eigen::Index max_training_samples = 50'000;
constexpr int max_rounds = 20;

Eigen::Index dimensionOf(const FeatureSet& features) {
  return (isBinary(features.kind) ? 8 : 1) * features.descriptors.cols();
}

/// A descriptor as a point of Euclidean space: entries as they are, bits as -1 and +1.
Eigen::RowVectorXf toVector(const FeatureSet& features, Eigen::Index row) {
  const auto descriptor = features.descriptors.row(row);
  if (!isBinary(features.kind)) return descriptor.cast<float>();
  Eigen::RowVectorXf vector(dimensionOf(features));
  for (Eigen::Index byte = 0; byte < descriptor.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit)
      vector[8 * byte + bit] = static_cast<float>(2 * (descriptor[byte] >> bit & 1) - 1);
  return vector;
}

/// At most max_training_samples descriptors, taken evenly over the sets.
RowMatrix trainingSamples(std::span<const FeatureSet* const> sets) {
  Eigen::Index total = 0;
  for (const FeatureSet* set : sets) total += set->size();
  if (total == 0) throw std::invalid_argument("no features to train a vocabulary from");
  const FeatureKind kind = sets.front()->kind;
  const auto* const first = *std::ranges::find_if(sets, [](const FeatureSet* set) { return set->size() > 0; });
  const Eigen::Index count = std::min(total, max_training_samples);
  RowMatrix samples(count, dimensionOf(*first));
  Eigen::Index sample = 0, passed = 0;
  for (const FeatureSet* set : sets) {
    if (set->kind != kind || (set->size() > 0 && set->descriptors.cols() != first->descriptors.cols()))
      throw std::invalid_argument("a vocabulary needs features of one kind");
    for (; sample < count && sample * total / count < passed + set->size(); ++sample)
      samples.row(sample) = toVector(*set, sample * total / count - passed);
    passed += set->size();
  }
  return samples;
}

/// k-means++ (Arthur and Vassilvitskii 2007): each further word is a sample drawn in proportion to its squared distance
/// from the words so far. Fewer different samples than words: that many words.
RowMatrix seedWords(const RowMatrix& samples, int count, Random& random) {
  RowMatrix words(count, samples.cols());
  words.row(0) = samples.row(random.below(static_cast<uint32_t>(samples.rows())));
  Eigen::VectorXf distance = Eigen::VectorXf::Constant(samples.rows(), std::numeric_limits<float>::max());
  for (int word = 1; word < count; ++word) {
    distance = distance.cwiseMin((samples.rowwise() - words.row(word - 1)).rowwise().squaredNorm());
    double left = random.uniform() * distance.cast<double>().sum();
    if (!(left > 0)) return words.topRows(word);
    Eigen::Index chosen = 0;
    while (chosen + 1 < samples.rows() && (left -= distance[chosen]) >= 0) ++chosen;
    words.row(word) = samples.row(chosen);
  }
  return words;
}

/// Row of the nearest word of each sample.
std::vector<Eigen::Index> nearestWords(const RowMatrix& samples, const RowMatrix& words) {
  const Eigen::RowVectorXf half_norms = 0.5f * words.rowwise().squaredNorm().transpose();
  const RowMatrix similarity = (samples * words.transpose()).rowwise() - half_norms;
  std::vector<Eigen::Index> nearest(static_cast<std::size_t>(samples.rows()));
  for (Eigen::Index i = 0; i < samples.rows(); ++i) similarity.row(i).maxCoeff(&nearest[static_cast<std::size_t>(i)]);
  return nearest;
}

/// Lloyd's rounds until nothing moves; a word that nothing is nearest to stays where it is.
RowMatrix refineWords(const RowMatrix& samples, RowMatrix words) {
  std::vector<Eigen::Index> previous;
  for (int round = 0; round < max_rounds; ++round) {
    std::vector<Eigen::Index> nearest = nearestWords(samples, words);
    if (nearest == previous) break;
    RowMatrix sums = RowMatrix::Zero(words.rows(), words.cols());
    Eigen::VectorXf counts = Eigen::VectorXf::Zero(words.rows());
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
      const Eigen::Index word = nearest[static_cast<std::size_t>(i)];
      sums.row(word) += samples.row(i);
      counts[word] += 1;
    }
    for (Eigen::Index word = 0; word < words.rows(); ++word)
      if (counts[word] > 0) words.row(word) = sums.row(word) / counts[word];
    previous = std::move(nearest);
  }
  return words;
}

}  // namespace

VladVocabulary VladVocabulary::train(std::span<const FeatureSet* const> sets, int words, uint64_t seed) {
  if (words < 1) throw std::invalid_argument("words is " + std::to_string(words) + ", not positive");
  const RowMatrix samples = trainingSamples(sets);
  Random random(seed);
  const int count = static_cast<int>(std::min<Eigen::Index>(words, samples.rows()));
  return {sets.front()->kind, refineWords(samples, seedWords(samples, count, random))};
}

VladVocabulary::VladVocabulary(FeatureKind kind, Eigen::MatrixXf words) : kind_(kind), words_(std::move(words)) {
  const Eigen::Index entries_of_byte = isBinary(kind) ? 8 : 1;
  if (words_.rows() == 0 || words_.cols() % entries_of_byte != 0 ||
      !isDescriptorLength(kind, words_.cols() / entries_of_byte) || !words_.allFinite())
    throw std::invalid_argument("vocabulary words are broken: " + std::to_string(words_.rows()) + " of " +
                                std::to_string(words_.cols()) + " entries");
}

Eigen::VectorXf VladVocabulary::describe(const FeatureSet& features) const {
  if (empty()) throw std::invalid_argument("vocabulary is empty");
  if (features.kind != kind_ || (features.size() > 0 && dimensionOf(features) != words_.cols()))
    throw std::invalid_argument("features are of another kind than the vocabulary");
  RowMatrix samples(features.size(), words_.cols());
  for (int i = 0; i < features.size(); ++i) samples.row(i) = toVector(features, i);
  RowMatrix residuals = RowMatrix::Zero(words_.rows(), words_.cols());
  const std::vector<Eigen::Index> nearest = nearestWords(samples, words_);
  for (int i = 0; i < features.size(); ++i) {
    const Eigen::Index word = nearest[static_cast<std::size_t>(i)];
    residuals.row(word) += samples.row(i) - words_.row(word);
  }
  for (Eigen::Index word = 0; word < residuals.rows(); ++word) residuals.row(word).normalize();
  const Eigen::VectorXf vlad = Eigen::Map<const Eigen::VectorXf>(residuals.data(), residuals.size());
  return (vlad.array().sign() * vlad.array().abs().sqrt()).matrix().normalized();
}

std::vector<RetrievedPlace> retrieve(const Eigen::MatrixXf& places, const Eigen::VectorXf& query, int count) {
  if (places.rows() != query.size())
    throw std::invalid_argument("place descriptors have " + std::to_string(places.rows()) + " entries, the query " +
                                std::to_string(query.size()));
  const Eigen::VectorXf similarity = places.transpose() * query;
  std::vector<RetrievedPlace> result(static_cast<std::size_t>(places.cols()));
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {static_cast<int>(i), similarity[static_cast<Eigen::Index>(i)]};
  const auto kept = std::min(result.size(), static_cast<std::size_t>(std::max(count, 0)));
  std::partial_sort(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(kept), result.end(),
                    [](const RetrievedPlace& a, const RetrievedPlace& b) {
                      return a.similarity != b.similarity ? a.similarity > b.similarity : a.index < b.index;
                    });
  result.resize(kept);
  return result;
}

}  // namespace vmcl
