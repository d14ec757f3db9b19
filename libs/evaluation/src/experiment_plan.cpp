// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/experiment_plan.h"

#include <sstream>
#include <stdexcept>

#include "vmcl/geometry/trajectory.h"
#include "vmcl/mrpt/localization_config.h"

namespace vmcl {
namespace {

constexpr std::size_t max_jobs = 1'000'000;

/// Of the ground truth, s.
double durationOf(const ExperimentSession& session) {
  const Trajectory truth = readTumTrajectory(session.ground_truth);
  if (truth.empty()) throw std::runtime_error(session.ground_truth.string() + ": holds no pose");
  return truth.poses().back().time - truth.poses().front().time;
}

/// Why the method cannot be run on the session; "" when it can.
std::string misfit(const ExperimentSession& session, const Configuration& configuration, Sensors sensors) {
  try {
    const LocalizationConfig config =
        loadLocalizationConfig(configuration.ini, session.maps, session.rawlog, {configuration.changes, sensors});
    const bool laser = sensors == Sensors::laser || sensors == Sensors::both;
    return laser && config.map_file.empty() ? "there is no .simplemap or .gridmap for the laser" : "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::string misfit(const Start& start, Sensors sensors, double duration) {
  if (sensors == Sensors::odometry && !start.given) return "odometry alone does not tell where the robot starts";
  if (sensors == Sensors::odometry && start.kidnapping) return "odometry alone does not tell where the robot was put";
  if (start.after >= duration) return "the ground truth ends before the robot starts";
  if (start.kidnapping && start.kidnapping->at + start.kidnapping->skip >= duration)
    return "the ground truth ends before the kidnapped robot sees again";
  return "";
}

std::string textOf(double seconds) {
  std::ostringstream text;
  text << seconds;
  return text.str();
}

std::string join(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ".") + word;
  return joined;
}

/// The experiment's combinations but for the seeds.
template <class Visit>
void forEachCombination(const Experiment& experiment, Visit&& visit) {
  for (std::size_t session = 0; session < experiment.sessions.size(); ++session)
    for (std::size_t start = 0; start < experiment.starts.size(); ++start)
      for (std::size_t configuration = 0; configuration < experiment.configurations.size(); ++configuration)
        for (const Sensors sensors : experiment.sensors) visit(session, Method{sensors, configuration}, start);
}

}  // namespace

ExperimentPlan planExperiment(const Experiment& experiment) {
  for (const Configuration& configuration : experiment.configurations)
    loadLocalizationConfig(configuration.ini, {}, experiment.sessions.front().rawlog,
                           {configuration.changes, std::nullopt});
  std::vector<double> durations;
  for (const ExperimentSession& session : experiment.sessions) durations.push_back(durationOf(session));
  ExperimentPlan plan;
  forEachCombination(experiment, [&](std::size_t s, const Method& method, std::size_t start) {
    const ExperimentSession& session = experiment.sessions[s];
    const Configuration& configuration = experiment.configurations[method.configuration];
    const std::string name =
        join({session.name, nameOf(method.sensors), configuration.name, experiment.starts[start].name});
    std::string reason = misfit(experiment.starts[start], method.sensors, durations[s]);
    if (reason.empty()) reason = misfit(session, configuration, method.sensors);
    if (!reason.empty()) {
      plan.skipped.push_back({name, reason});
      return;
    }
    for (int seed = 1; seed <= experiment.seeds; ++seed) {
      if (plan.jobs.size() == max_jobs)
        throw std::runtime_error(experiment.file.string() + ": asks for more than " + std::to_string(max_jobs) +
                                 " runs");
      plan.jobs.push_back({name + '.' + std::to_string(seed), s, method, start, static_cast<uint64_t>(seed)});
    }
  });
  if (plan.jobs.empty())
    throw std::runtime_error(experiment.file.string() + ": no combination makes sense: " + plan.skipped.front().name +
                             ": " + plan.skipped.front().reason);
  return plan;
}

std::vector<std::string> commandOf(const Experiment& experiment, const Job& job) {
  const ExperimentSession& session = experiment.sessions[job.session];
  const Configuration& configuration = experiment.configurations[job.method.configuration];
  const Start& start = experiment.starts[job.start];
  std::vector<std::string> command{"localize",      configuration.ini.string(),    "--rawlog", session.rawlog.string(),
                                   "--groundtruth", session.ground_truth.string(), "--sensors"};
  command.push_back(nameOf(job.method.sensors));
  for (const auto& map : session.maps) command.insert(command.end(), {"--map", map.string()});
  for (const std::string& change : configuration.changes) command.insert(command.end(), {"--set", change});
  command.insert(command.end(), {"--start", start.given ? "given" : "global"});
  if (start.after > 0) command.insert(command.end(), {"--skip", textOf(start.after)});
  if (start.kidnapping)
    command.insert(command.end(), {"--kidnap", textOf(start.kidnapping->at), textOf(start.kidnapping->skip)});
  const std::vector<std::string> disturbance = optionsOf(session.disturbance);
  command.insert(command.end(), disturbance.begin(), disturbance.end());
  command.insert(command.end(), {"--seed", std::to_string(job.seed), "--tables-only"});
  return command;
}

std::vector<std::string> optionsOf(const Disturbance& disturbance) {
  std::vector<std::string> options;
  const auto add = [&](const char* option, const std::vector<double>& values) {
    options.emplace_back(option);
    for (const double value : values) options.push_back(textOf(value));
  };
  if (disturbance.dropped_images > 0) add("--drop-images", {disturbance.dropped_images});
  if (const auto& dim = disturbance.dimming) add("--dim", {dim->at, dim->lasts, dim->light});
  if (disturbance.odometry_scale != 1) add("--odometry-scale", {disturbance.odometry_scale});
  return options;
}

std::string nameOf(const Experiment& experiment, const Method& method) {
  const std::string& sensors = nameOf(method.sensors);
  return experiment.configurations.size() == 1 ? sensors
                                               : sensors + ' ' + experiment.configurations[method.configuration].name;
}

}  // namespace vmcl
