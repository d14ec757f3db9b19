// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/localization_report.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const ErrorStatistics& statistics) {
  return {{"rmse", statistics.rmse}, {"median", statistics.median}, {"max", statistics.max}};
}

Json toJson(const TrajectoryEvaluation& evaluation) {
  Json json = {{"compared_frames", evaluation.compared},
               {"converged", evaluation.time_to_converge.has_value()},
               {"success_share", evaluation.success_share},
               {"false_accepts", evaluation.false_accepts},
               {"position_error_localized", toJson(evaluation.position)},
               {"heading_error_localized", toJson(evaluation.heading)}};
  if (evaluation.time_to_converge) {
    json["time_to_converge"] = *evaluation.time_to_converge;
    json["position_error_after_convergence"] = toJson(evaluation.position_after);
    json["heading_error_after_convergence"] = toJson(evaluation.heading_after);
  }
  return json;
}

}  // namespace

std::vector<TimedEstimate> estimatesOf(const std::vector<LocalizationFrame>& frames) {
  std::vector<TimedEstimate> estimates;
  for (const LocalizationFrame& frame : frames)
    estimates.push_back({frame.time, frame.localized, frame.cluster.robot_in_map});
  return estimates;
}

void writeTrajectory(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames) {
  std::vector<StampedPose> poses;
  for (const LocalizationFrame& frame : frames)
    if (frame.localized && (poses.empty() || frame.time > poses.back().time))
      poses.push_back({frame.time, toRigid3(frame.cluster.robot_in_map)});
  writeTumTrajectory(file, Trajectory(std::move(poses)));
}

void writeFrames(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames) {
  AtomicFile out(file);
  out.stream() << "t[s],status,x[m],y[m],phi[rad],cov_xx,cov_xy,cov_xphi,cov_yy,cov_yphi,cov_phiphi,cluster_share,ess,"
                  "particles,inliers\n";
  for (const LocalizationFrame& frame : frames) {
    const PoseCluster& cluster = frame.cluster;
    const Eigen::Matrix3d& c = cluster.covariance;
    out.stream() << std::fixed << std::setprecision(6) << frame.time << ',' << nameOf(frame.health.status) << ','
                 << std::defaultfloat << std::setprecision(9) << cluster.robot_in_map.x << ',' << cluster.robot_in_map.y
                 << ',' << cluster.robot_in_map.phi << ',' << c(0, 0) << ',' << c(0, 1) << ',' << c(0, 2) << ','
                 << c(1, 1) << ',' << c(1, 2) << ',' << c(2, 2) << ',' << cluster.share << ','
                 << frame.effective_share * frame.particles << ',' << frame.particles << ',' << frame.inliers << '\n';
  }
  out.commit();
}

void writeTiming(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames) {
  AtomicFile out(file);
  out.stream() << "t[s],latency[s]\n" << std::fixed << std::setprecision(6);
  for (const LocalizationFrame& frame : frames) out.stream() << frame.time << ',' << frame.latency << '\n';
  out.commit();
}

void writeSummary(const std::filesystem::path& file, const LocalizationRun& run) {
  const auto& frames = run.frames;
  Json json = {{"frames", frames.size()},
               {"localized_frames", std::count_if(frames.begin(), frames.end(), [](auto& f) { return f.localized; })}};
  if (!frames.empty()) {
    const LocalizationFrame& last = frames.back();
    json["final"] = {
        {"time", last.time},
        {"localized", last.localized},
        {"robot_in_map", {last.cluster.robot_in_map.x, last.cluster.robot_in_map.y, last.cluster.robot_in_map.phi}},
        {"position_deviation", last.cluster.positionDeviation()},
        {"heading_deviation", last.cluster.headingDeviation()}};
  }
  if (run.kidnapped) json["kidnapped"] = {{"from", run.kidnapped->from}, {"until", run.kidnapped->until}};
  if (run.ground_truth) json["ground_truth"] = toJson(evaluateTrajectory(estimatesOf(frames), *run.ground_truth));
  AtomicFile out(file);
  out.stream() << json.dump(2) << '\n';
  out.commit();
}

}  // namespace vmcl
