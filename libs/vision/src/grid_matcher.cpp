// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>
#include <utility>

#include "grid_descriptors.h"
#include "nearest_descriptors.h"
#include "vmcl/vision/dense_matching.h"

namespace vmcl {
namespace {

constexpr float mutual_px = 1.5f * dense_grid_step;  // grids of the two images do not coincide
constexpr int neighbourhood = 24;                    // pixels to each side of which neighbours lie
constexpr float bend_px = dense_grid_step;           // displacements of neighbours differ by the query grid's step
constexpr float bend = 0.3f;                         // and, as scale and perspective do, by a part of their distance
constexpr std::size_t min_neighbours = 6;
constexpr float max_refinement_px = 1.5f * dense_grid_step;
constexpr float max_return_px = 1;

/// A point of the reference and where the query seems to show it.
struct Guess {
  int point = 0;
  Eigen::Vector2f reference, query;
};

cv::Mat greyOf(const ImageView& view) {
  if (view.empty()) throw std::invalid_argument("image is empty");
  const cv::Mat image(view.height, view.width, view.channels == 1 ? CV_8UC1 : CV_8UC3,
                      const_cast<uint8_t*>(view.pixels), view.row_bytes);
  cv::Mat grey;
  if (view.channels == 1) return image.clone();
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

/// The image with mean and deviation about each pixel made the same, which takes light and shade away.
cv::Mat evenContrast(const cv::Mat& grey) {
  cv::Mat image, mean, square, even;
  grey.convertTo(image, CV_32F);
  const cv::Size window(31, 31);
  cv::boxFilter(image, mean, -1, window);
  cv::sqrBoxFilter(image, square, CV_32F, window);
  cv::Mat deviation;
  cv::sqrt(cv::max(square - mean.mul(mean), 0), deviation);
  cv::divide(image - mean, deviation + 4, even, 40);  // 4 grey levels: noise is not blown up
  even.convertTo(even, CV_8U, 1, 128);
  return even;
}

/// Guesses whose neighbours in the reference move mostly as they do.
std::vector<Guess> inConsensus(const std::vector<Guess>& guesses) {
  std::map<std::pair<int, int>, std::vector<const Guess*>> cells;
  const auto cellOf = [](const Eigen::Vector2f& pixel) {
    return std::pair(static_cast<int>(pixel.x()) / neighbourhood, static_cast<int>(pixel.y()) / neighbourhood);
  };
  for (const Guess& guess : guesses) cells[cellOf(guess.reference)].push_back(&guess);
  std::vector<Guess> kept;
  for (const Guess& guess : guesses) {
    std::size_t neighbours = 0, agreeing = 0;
    const auto [column, row] = cellOf(guess.reference);
    for (int i = 0; i < 9; ++i) {
      const auto cell = cells.find({column + i % 3 - 1, row + i / 3 - 1});
      if (cell == cells.end()) continue;
      for (const Guess* other : cell->second) {
        const float distance = (other->reference - guess.reference).lpNorm<Eigen::Infinity>();
        if (other == &guess || distance > neighbourhood) continue;
        const Eigen::Vector2f difference = (other->query - other->reference) - (guess.query - guess.reference);
        ++neighbours;
        agreeing += difference.lpNorm<Eigen::Infinity>() <= bend_px + bend * distance;
      }
    }
    if (agreeing >= min_neighbours && 2 * agreeing > neighbours) kept.push_back(guess);
  }
  return kept;
}

class GridMatcher : public DenseMatcher {
 public:
  GridMatcher(const ImageView& query, const ImageMask& mask)
      : mask_(mask),
        even_(evenContrast(greyOf(query))),
        grid_(denseGrid(query.width, query.height, mask)),
        described_(describePoints(greyOf(query), grid_)),
        blocks_(FeatureKind::sift, described_.descriptors) {}

  std::vector<DenseMatch> match(const ImageView& reference, std::span<const Eigen::Vector2f> points) const override {
    const cv::Mat grey = greyOf(reference);
    return refined(inConsensus(guesses(describePoints(grey, points), points)), evenContrast(grey));
  }

 private:
  const Eigen::Vector2f& gridPixel(int described_row) const {
    return grid_[static_cast<std::size_t>(described_.points[static_cast<std::size_t>(described_row)])];
  }

  /// Nearest in the query's grid, whose own nearest is no other place.
  std::vector<Guess> guesses(const GridDescriptors& reference, std::span<const Eigen::Vector2f> points) const {
    std::vector<int> rows(reference.points.size());
    std::iota(rows.begin(), rows.end(), 0);
    if (rows.empty() || described_.points.empty()) return {};
    const std::vector<Nearest> there = nearestAmong(blocks_, reference.descriptors, rows);
    std::vector<int> named;
    for (const Nearest& nearest : there) named.push_back(nearest.row);
    std::ranges::sort(named);
    named.erase(std::ranges::unique(named).begin(), named.end());
    const std::vector<Nearest> back =
        nearestAmong(DescriptorBlocks(FeatureKind::sift, reference.descriptors), described_.descriptors, named);
    std::vector<Guess> guesses;
    for (const int row : rows) {
      const int point = reference.points[static_cast<std::size_t>(row)];
      const int grid_row = there[static_cast<std::size_t>(row)].row;
      const auto index = std::ranges::lower_bound(named, grid_row) - named.begin();
      const int returned = reference.points[static_cast<std::size_t>(back[static_cast<std::size_t>(index)].row)];
      const Eigen::Vector2f& pixel = points[static_cast<std::size_t>(point)];
      if ((points[static_cast<std::size_t>(returned)] - pixel).lpNorm<Eigen::Infinity>() <= mutual_px)
        guesses.push_back({point, pixel, gridPixel(grid_row)});
    }
    return guesses;
  }

  std::vector<DenseMatch> refined(const std::vector<Guess>& guesses, const cv::Mat& reference) const {
    std::vector<DenseMatch> matches;
    if (guesses.empty()) return matches;
    std::vector<cv::Point2f> from, start, to;
    for (const Guess& guess : guesses) {
      from.emplace_back(guess.reference.x(), guess.reference.y());
      start.emplace_back(guess.query.x(), guess.query.y());
    }
    to = start;
    const std::vector<uint8_t> found = track(reference, even_, from, to);
    std::vector<cv::Point2f> returned = from;
    const std::vector<uint8_t> found_back = track(even_, reference, to, returned);
    for (std::size_t i = 0; i < guesses.size(); ++i)
      if (found[i] && found_back[i] && cv::norm(to[i] - start[i]) <= max_refinement_px &&
          cv::norm(returned[i] - from[i]) <= max_return_px && !mask_.hides({to[i].x, to[i].y}))
        matches.push_back({guesses[i].point, {to[i].x, to[i].y}});
    return matches;
  }

  static std::vector<uint8_t> track(const cv::Mat& from, const cv::Mat& to, const std::vector<cv::Point2f>& points,
                                    std::vector<cv::Point2f>& moved) {
    std::vector<uint8_t> found;
    cv::calcOpticalFlowPyrLK(from, to, points, moved, found, cv::noArray(), {15, 15}, 1,
                             {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 15, 0.02}, cv::OPTFLOW_USE_INITIAL_FLOW,
                             1e-3);
    return found;
  }

  ImageMask mask_;
  cv::Mat even_;
  std::vector<Eigen::Vector2f> grid_;
  GridDescriptors described_;
  DescriptorBlocks blocks_;
};

}  // namespace

std::vector<Eigen::Vector2f> denseGrid(int width, int height, const ImageMask& mask) {
  mask.check(width, height);
  constexpr int margin = dense_grid_step;
  std::vector<Eigen::Vector2f> points;
  for (int y = mask.rows_from_top + margin; y < height - margin; y += dense_grid_step)
    for (int x = margin; x < width - margin; x += dense_grid_step) points.emplace_back(x, y);
  std::erase_if(points, [&](const Eigen::Vector2f& point) { return mask.hides(point); });
  return points;
}

std::unique_ptr<DenseMatcher> gridMatcher(const ImageView& query, const ImageMask& mask) {
  return std::make_unique<GridMatcher>(query, mask);
}

}  // namespace vmcl
