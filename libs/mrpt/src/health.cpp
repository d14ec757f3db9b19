// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/health.h"

#include <algorithm>
#include <array>

#include "option_range.h"

namespace vmcl {

std::string_view nameOf(LocalizationStatus status) {
  static constexpr std::array<std::string_view, 5> names{"uninitialized", "searching", "tracking", "degraded", "lost"};
  return names[static_cast<std::size_t>(status)];
}

void HealthOptions::check() const {
  demandPositive("degraded_after", degraded_after);
  demand(lost_after >= 1, "lost_after", lost_after, "at least 1");
  demandNotNegative("lost_reset_after", lost_reset_after);
}

void UpdateEvidence::count(Verdict verdict) {
  testable += verdict != Verdict::untestable;
  agreeing += verdict == Verdict::agrees;
  contradicting += verdict == Verdict::contradicts;
}

HealthMonitor::HealthMonitor(const HealthOptions& options) : options_(options) { options_.check(); }

void HealthMonitor::restart() { *this = HealthMonitor(options_); }

void HealthMonitor::rest(double duration) {
  if (confirmed_at_ && duration > 0) *confirmed_at_ += duration;
}

const Health& HealthMonitor::update(const UpdateEvidence& evidence) {
  tested_ = tested_ || evidence.testable > 0;
  const bool agreed = evidence.agreeing > 0 && evidence.contradicting == 0;
  confirmed_ = confirmed_ || agreed;
  // Later than now only when a clock was set back.
  confirmed_at_ = agreed ? evidence.time : std::min(confirmed_at_.value_or(evidence.time), evidence.time);
  if (agreed)
    health_.contradictions = 0;
  else if (evidence.contradicting > 0 && evidence.agreeing == 0)
    ++health_.contradictions;
  health_.unconfirmed_for = evidence.time - *confirmed_at_;
  health_.last = evidence;
  health_.status = next(evidence);
  return health_;
}

LocalizationStatus HealthMonitor::next(const UpdateEvidence& evidence) const {
  using enum LocalizationStatus;
  const bool was_known = health_.status == tracking || health_.status == degraded;
  if (evidence.jumped || evidence.scattered || health_.contradictions >= options_.lost_after)
    return was_known || health_.status == lost ? lost : searching;
  const bool confirmed =
      !tested_ || (confirmed_ && health_.unconfirmed_for <= options_.degraded_after && health_.contradictions == 0);
  if (evidence.steady && confirmed && !evidence.blind_motion) return tracking;
  if (was_known) return degraded;
  return health_.status == lost ? lost : searching;
}

}  // namespace vmcl
