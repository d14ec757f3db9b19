// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vmcl/study/confidence_interval.h"
#include "vmcl/study/pose_method.h"
#include "vmcl/study/simulated_world.h"

namespace vmcl {

/// The figures of the simulation study of Jiao et al. 2020, what tilt does, and what estimates cost.
enum class Figure {
  accuracy,         ///< errors against pixel noise, no outliers
  success,          ///< success rate against outlier rate and depth rate
  tilt,             ///< success rate against the robot's tilt, of which the planar methods know nothing
  cost_of_matches,  ///< time against the number of matches
  cost_of_cameras,  ///< time against the number of cameras
};

/// "accuracy", "success", "tilt", "cost-matches" or "cost-cameras".
std::string_view nameOf(Figure figure);

/// An estimate is a success when it is nearer to the truth than both.
inline constexpr double success_distance = 0.1;      ///< m
inline constexpr double success_angle = 1 * degree;  ///< rad

/// One point of a figure: trials of one kind of world.
struct StudyCell {
  Figure figure = Figure::accuracy;
  int number = 0;  ///< of the cell in the whole study: picks its random numbers, whichever figures are asked for
  WorldSettings world;
};

/// All cells of these figures.
std::vector<StudyCell> studyCells(const std::vector<Figure>& figures);

/// Those that can take part in a cell, the same in all cells of a world and figure: for several cameras the methods
/// that take rigs; with tilt, the one that allows for it as well.
std::vector<PoseMethod> methodsOf(const StudyCell& cell);

/// What the methods of the cell are told about it.
MethodSettings settingsOf(const StudyCell& cell, int trial);

/// Errors of a pose.
struct EstimationError {
  double distance = 0;            ///< m
  double angle = 0;               ///< rad
  double squared_over_bound = 0;  ///< squared Mahalanobis length under the Cramer-Rao bound; 3 on average if efficient

  bool isSuccess() const { return distance < success_distance && angle < success_angle; }
};

struct MethodOutcome {
  std::optional<EstimationError> error;  ///< nothing: no pose found
  bool any_success = false;              ///< whether one of the poses found is a success
  double seconds = 0;                    ///< processor time
};

struct TrialResult {
  std::vector<MethodOutcome> outcomes;  ///< in the order of methodsOf(), then the likelihood optimized from the truth
  std::optional<EstimationError> cramer_rao;  ///< roots of the bound's traces; nothing: inliers do not fix the pose
};

/// Draws the trial's problem and lets each method solve it. The same arguments give the same result, but for seconds.
TrialResult runTrial(const StudyCell& cell, const std::vector<PoseMethod>& methods, uint64_t seed, int trial);

/// Errors over the trials that gave a pose.
struct ErrorSummary {
  double rms = 0;
  Interval rms_interval;
  double median = 0;
};

/// A row of the study's tables.
struct MethodSummary {
  std::string method;
  int trials = 0;
  int answered = 0;
  int successes = 0;
  int any_successes = 0;  ///< trials in which one of the poses found was a success
  ErrorSummary distance;  ///< m
  ErrorSummary angle;     ///< rad
  double over_bound = 0;  ///< RMS error of the successes over what Cramer and Rao allow; 1: efficient
  Interval over_bound_interval;
  std::array<double, 3> seconds{};  ///< processor time of an estimate, quartiles
};

inline constexpr const char* bound_name = "bound";            ///< the likelihood optimized from the truth
inline constexpr const char* cramer_rao_name = "Cramer-Rao";  ///< has errors only; answered: where it exists

/// A cell with what came of its trials.
struct CellSummary {
  StudyCell cell;
  std::vector<MethodSummary> rows;
};

/// The methods' rows, the bound's and Cramer-Rao's.
std::vector<MethodSummary> summarize(const std::vector<PoseMethod>& methods, const std::vector<TrialResult>& trials);

}  // namespace vmcl
