// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace vmcl {

/// How far the reported pose can be trusted.
enum class LocalizationStatus {
  uninitialized,  ///< no start is given, or nothing has been seen yet
  searching,      ///< since the start the particles have not agreed on one pose
  tracking,       ///< one pose, which moves as the odometry says, and which the sensors confirm
  degraded,       ///< one pose, but for a while unconfirmed: dead reckoning
  lost            ///< the pose that was tracked is refuted or gone
};

/// "uninitialized", "searching", ...
std::string_view nameOf(LocalizationStatus status);

/// What one observation says about the pose.
enum class Verdict { untestable, silent, agrees, contradicts };

struct HealthOptions {
  double degraded_after = 1.0;  ///< s without an observation that agrees
  int lost_after = 3;           ///< contradictions in a row
  double lost_reset_after = 5;  ///< s lost, after which half the particles start anywhere, again and again; before,
                                ///< after a fifth of it, half of them are spread about where they were; 0: neither

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// What one update shows of the health of the estimate.
struct UpdateEvidence {
  double time = 0;            ///< s
  bool steady = false;        ///< a narrow cluster that has moved as the odometry says, by LocalizedRule
  bool jumped = false;        ///< a narrow cluster over 1 m or 45 deg from the one before moved by the odometry
  bool scattered = false;     ///< no cluster tells the pose to a metre
  bool blind_motion = false;  ///< the odometry has stopped
  int testable = 0;           ///< observations that can tell poses apart
  int agreeing = 0;           ///< of them
  int contradicting = 0;      ///< of them

  void count(Verdict verdict);
};

/// The status and its evidence.
struct Health {
  LocalizationStatus status = LocalizationStatus::uninitialized;
  double unconfirmed_for = 0;  ///< s since an update whose observations agreed with the pose, none contradicting, or
                               ///< since the first
  int contradictions = 0;      ///< updates in a row with an observation that contradicts and none that agrees
  UpdateEvidence last;         ///< of the last update
};

/// Follows the status from update to update:
/// - tracking needs a steady cluster, agreement within degraded_after, and no contradiction since;
/// - what was tracked is lost after lost_after contradictions, a jump, or when the particles scatter, and else
/// degraded;
/// - lost and searching last until tracking.
/// With nothing but untestable observations (odometry alone) a steady cluster is enough.
class HealthMonitor {
 public:
  /// Throws std::invalid_argument naming the bad key.
  explicit HealthMonitor(const HealthOptions& options);

  /// Forgets all: the particles start anew.
  void restart();

  /// They were those of another map.
  void forgetContradictions() { health_.contradictions = 0; }

  /// The robot has stood still for so long (s): there was nothing to confirm.
  void rest(double duration);

  const Health& update(const UpdateEvidence& evidence);
  const Health& health() const { return health_; }

 private:
  LocalizationStatus next(const UpdateEvidence& evidence) const;

  HealthOptions options_;
  Health health_;
  bool tested_ = false;                 ///< some observation was testable
  bool confirmed_ = false;              ///< some observation agreed
  std::optional<double> confirmed_at_;  ///< s: when last, or else when the first update was
};

}  // namespace vmcl
