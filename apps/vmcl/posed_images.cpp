// SPDX-License-Identifier: BSD-3-Clause
#include "posed_images.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/mrpt/error_message.h"

namespace vmcl {
namespace {

bool sameCamera(const PinholeCamera& a, const PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

mrpt::maps::CSimpleMap loadSimpleMap(const std::filesystem::path& file) try {
  mrpt::io::CFileGZInputStream stream;
  if (!std::filesystem::is_regular_file(file) || !stream.open(file.string()))
    throw std::runtime_error("cannot be opened");
  mrpt::maps::CSimpleMap simple_map;
  mrpt::serialization::archiveFrom(stream) >> simple_map;
  return simple_map;
} catch (const std::exception& error) {
  throw std::runtime_error(file.string() + ": " + errorMessage(error));
}

Rigid3 meanPose(const mrpt::poses::CPose3DPDF& distribution) {
  Rigid3 pose = Rigid3::Identity();
  pose.matrix() = distribution.getMeanVal().getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen();
  return pose;
}

}  // namespace

int PosedImages::cameraOf(const CameraObservation& seen) {
  const auto [entry, is_new] = camera_of_label_.try_emplace(seen.label, 0, seen.calibration.pinhole);
  if (is_new) entry->second.first = builder_.addCamera({seen.label, seen.calibration, seen.robot_from_camera, 0});
  if (!sameCamera(entry->second.second, seen.calibration.pinhole))
    throw std::runtime_error("camera '" + seen.label + "': other intrinsics than in its first image");
  return entry->second.first;
}

void PosedImages::offer(const std::filesystem::path& file, const mrpt::obs::CObservation& observation,
                        const std::function<std::optional<Rigid3>(double)>& pose_at) try {
  const auto seen = cameraObservation(observation);
  if (!seen) return;
  ++images_;
  const auto map_from_robot = pose_at(seen->time);
  if (!map_from_robot) {
    ++images_without_pose_;
    return;
  }
  builder_.add(seen->time, cameraOf(*seen), *map_from_robot, seen->image.view());
} catch (const std::exception& error) {
  problems_.add(file.string() + ": " + errorMessage(error));
}

void PosedImages::readRawlog(const std::filesystem::path& file, const Trajectory& trajectory,
                             const ReadProgress& progress) {
  RawlogReader reader(file);
  const auto pose_at = [&](double time) { return trajectory.at(time); };
  RawlogEntry entry;
  try {
    while (reader.next(entry)) {
      if (entry.observation) offer(file, *entry.observation, pose_at);
      if (entry.frame)
        for (const auto& observation : *entry.frame) offer(file, *observation, pose_at);
      progress(reader.progress());
    }
  } catch (const std::exception& error) {  // what came before the damage is still good
    problems_.add(errorMessage(error));
  }
}

void PosedImages::readSimpleMap(const std::filesystem::path& file, const ReadProgress& progress) {
  const mrpt::maps::CSimpleMap simple_map = loadSimpleMap(file);
  double done = 0;
  for (const auto& [distribution, frame] : simple_map) {
    if (!distribution || !frame) throw std::runtime_error(file.string() + ": an entry without pose or observations");
    const Rigid3 map_from_robot = meanPose(*distribution);
    for (const auto& observation : *frame) offer(file, *observation, [&](double) { return map_from_robot; });
    progress(++done / static_cast<double>(simple_map.size()));
  }
}

}  // namespace vmcl
