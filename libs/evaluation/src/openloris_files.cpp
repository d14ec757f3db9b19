// SPDX-License-Identifier: BSD-3-Clause
#include "openloris_files.h"

#include <iomanip>
#include <map>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

void writeSequence(std::ostream& out, int number, const RunResult& run) {
  out << "\nseq: " << number << '\n';
  for (const RunUpdate& update : run.updates) {
    if (!update.estimate.localized) continue;
    const PlanarPose& pose = update.estimate.robot_in_map;
    out << std::fixed << std::setprecision(6) << update.estimate.time << ' ' << std::setprecision(9) << pose.x << ' '
        << pose.y << " 0 0 0 " << std::sin(pose.phi / 2) << ' ' << std::cos(pose.phi / 2) << '\n';
  }
}

}  // namespace

void writeOpenLorisFiles(const std::filesystem::path& directory, const ExperimentResults& results) {
  const Experiment& experiment = results.experiment;
  std::map<std::pair<std::string, std::string>, std::map<int, const RunResult*>> scenes;  // by folder and scene
  for (const RunResult& run : results.runs) {
    const ExperimentSession& session = experiment.sessions[run.job.session];
    if (!session.openloris || !run.end.done) continue;
    const std::string folder = run.job.id.substr(session.name.size() + 1);
    scenes[{folder, session.openloris->scene}][session.openloris->number] = &run;
  }
  for (const auto& [place, sequences] : scenes) {
    const auto& [folder, scene] = place;
    std::filesystem::create_directories(directory / "openloris" / folder);
    AtomicFile file(directory / "openloris" / folder / (scene + ".txt"));
    file.stream() << "scene: " << scene << "\nframe: base_link\n";
    for (const auto& [number, run] : sequences) writeSequence(file.stream(), number, *run);
    file.commit();
  }
}

}  // namespace vmcl
