// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/image_measurements.h"

#include <algorithm>
#include <array>

#include "match_store.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/query_image.h"

namespace vmcl {
namespace {

constexpr std::size_t remembered = 16;  // images: more than the cameras of a robot

/// So many of the matches, evenly spaced in their order, which goes from reference to reference.
PoseProblem thinned(const PoseProblem& problem, std::size_t count) {
  PoseProblem some{problem.query_cameras, problem.reference_cameras, {}};
  const std::size_t all = problem.matches.size();
  for (std::size_t i = 0; i < count; ++i) some.matches.push_back(problem.matches[i * all / count]);
  return some;
}

}  // namespace

double ImageMeasurement::logLikelihood(const PlanarPose& robot_in_map) const {
  double value = 0;
  addLogLikelihoods({&robot_in_map, 1}, {&value, 1});
  return value;
}

void ImageMeasurement::addLogLikelihoods(std::span<const PlanarPose> robot_in_map,
                                         std::span<double> log_likelihoods) const {
  if (!likelihood) return;
  constexpr std::size_t block = 64;
  std::array<PlanarTransform, block> poses;
  std::array<double, block> values;
  for (std::size_t first = 0; first < robot_in_map.size(); first += block) {
    const auto some = robot_in_map.subspan(first, std::min(block, robot_in_map.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) poses[i] = PlanarTransform(some[i]);
    likelihood->evaluate({poses.data(), some.size()}, {values.data(), some.size()});
    for (std::size_t i = 0; i < some.size(); ++i)
      if (isFinite(some[i])) log_likelihoods[first + i] += weight * values[i];
  }
}

ImageMeasurements::ImageMeasurements(std::shared_ptr<const KeyframeMap> map, const VisualMapOptions& options)
    : options_(options), relocalizer_(std::move(map), options.relocalizer) {}

std::shared_ptr<const ImageMeasurement> ImageMeasurements::of(const mrpt::obs::CObservation& observation,
                                                              const PoseWithCovariance* expected) {
  const std::scoped_lock lock(mutex_);
  const auto known = std::find_if(recent_.begin(), recent_.end(), [&](const Entry& entry) {
    return entry.address == &observation && entry.time == observation.timestamp &&
           entry.label == observation.sensorLabel;
  });
  if (known != recent_.end()) return known->measurement;
  const auto measurement = std::make_shared<ImageMeasurement>();
  try {
    measure(observation, expected, *measurement);
  } catch (const std::exception& error) {
    measurement->error = errorMessage(error);
  }
  recent_.push_front({&observation, observation.timestamp, observation.sensorLabel, measurement});
  if (recent_.size() > remembered) recent_.pop_back();
  return measurement;
}

std::shared_ptr<const ImageMeasurement> ImageMeasurements::latest() {
  const std::scoped_lock lock(mutex_);
  return recent_.empty() ? nullptr : recent_.front().measurement;
}

PoseProblem ImageMeasurements::match(const mrpt::obs::CObservation& observation,
                                     const PoseWithCovariance* expected) const {
  const MatchStore store(options_);
  if (auto known = store.find(observation)) return *std::move(known);
  const auto camera = cameraObservation(observation);
  if (!camera) return {};
  const QueryImage query = queryImage(*camera, relocalizer_.map());
  if (expected && options_.match_directory.empty())
    return relocalizer_.match({&query, 1}, {expected->robot_in_map, expected->covariance}).problem;
  PoseProblem problem = relocalizer_.match({&query, 1}).problem;
  store.keep(observation, problem);
  return problem;
}

void ImageMeasurements::measure(const mrpt::obs::CObservation& observation, const PoseWithCovariance* expected,
                                ImageMeasurement& measurement) const {
  measurement.problem = match(observation, expected);
  if (measurement.problem.matches.empty()) return;
  LikelihoodOptions of_particles = options_.relocalizer.estimator.likelihood;
  of_particles.sigma_px = options_.particle_sigma_px;
  const std::size_t all = measurement.problem.matches.size();
  const std::size_t most = options_.max_matches > 0 ? static_cast<std::size_t>(options_.max_matches) : all;
  const std::size_t used = std::min(most, all);
  const auto count = static_cast<double>(all);
  measurement.independent_matches = count / (1 + (count - 1) * options_.match_correlation);
  measurement.weight = measurement.independent_matches / static_cast<double>(used);
  measurement.likelihood.emplace(used < all ? thinned(measurement.problem, used) : measurement.problem, of_particles);
}

}  // namespace vmcl
