// SPDX-License-Identifier: BSD-3-Clause
#include "tracks.h"

#include <algorithm>
#include <numeric>

namespace vmcl {
namespace {

/// Disjoint sets of features, each with the sorted keyframes it touches.
class TrackForest {
 public:
  explicit TrackForest(std::span<const int> feature_counts) : first_feature_(feature_counts.size() + 1, 0) {
    std::partial_sum(feature_counts.begin(), feature_counts.end(), first_feature_.begin() + 1);
    parent_.resize(static_cast<std::size_t>(first_feature_.back()));
    std::iota(parent_.begin(), parent_.end(), 0);
    members_.resize(parent_.size());
    for (int keyframe = 0; keyframe < std::ssize(feature_counts); ++keyframe)
      for (int feature = 0; feature < feature_counts[keyframe]; ++feature)
        members_[first_feature_[keyframe] + feature] = {{keyframe, feature}};
  }

  void joinIfDisjoint(const Observation& first, const Observation& second) {
    int a = root(first), b = root(second);
    if (a == b || shareKeyframe(members_[a], members_[b])) return;
    if (members_[a].size() < members_[b].size()) std::swap(a, b);
    Track joined;
    std::merge(members_[a].begin(), members_[a].end(), members_[b].begin(), members_[b].end(),
               std::back_inserter(joined), earlier);
    members_[a] = std::move(joined);
    members_[b].clear();
    parent_[b] = a;
  }

  std::vector<Track> take(int min_length) {
    std::erase_if(members_, [min_length](const Track& track) { return std::ssize(track) < min_length; });
    return std::move(members_);
  }

 private:
  static bool earlier(const Observation& a, const Observation& b) { return a.keyframe < b.keyframe; }

  static bool shareKeyframe(const Track& a, const Track& b) {
    for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
      if (i->keyframe == j->keyframe) return true;
      earlier(*i, *j) ? ++i : ++j;
    }
    return false;
  }

  int root(const Observation& observation) {
    int node = first_feature_[observation.keyframe] + observation.feature;
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

  std::vector<int> first_feature_;  // per keyframe
  std::vector<int> parent_;
  std::vector<Track> members_;
};

}  // namespace

std::vector<Track> joinTracks(std::span<const int> feature_counts, std::vector<ObservationMatch> matches,
                              int min_length) {
  std::ranges::stable_sort(matches, {}, &ObservationMatch::ratio);
  TrackForest forest(feature_counts);
  for (const ObservationMatch& match : matches) forest.joinIfDisjoint(match.first, match.second);
  std::vector<Track> tracks = forest.take(min_length);
  std::ranges::stable_sort(tracks, {},
                           [](const Track& track) { return std::pair(track.front().keyframe, track.front().feature); });
  return tracks;
}

}  // namespace vmcl
