// SPDX-License-Identifier: BSD-3-Clause
#include "posed_images.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <stdexcept>

#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/datasets/rawlog_writer.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/measured_depth.h"
#include "vmcl/mrpt/object_file.h"
#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {

Image PosedImages::maskOf(const std::string& label) const {
  auto mask = masks_.find(label);
  if (mask == masks_.end()) mask = masks_.find("");
  return mask == masks_.end() ? Image() : mask->second;
}

std::string PosedImages::maskWithoutCamera() const {
  for (const auto& entry : masks_)
    if (!entry.first.empty() && !camera_of_label_.contains(entry.first)) return entry.first;
  return {};
}

int PosedImages::cameraOf(const CameraObservation& seen, DepthSource depth) {
  const auto [entry, is_new] = camera_of_label_.try_emplace(seen.label, 0, seen.calibration);
  if (is_new)
    entry->second.first =
        builder_.addCamera({seen.label, seen.calibration, seen.robot_from_camera, 0, maskOf(seen.label), depth});
  if (!sameCalibration(entry->second.second, seen.calibration))
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
  const bool is_stereo = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation) != nullptr;
  const int camera = cameraOf(*seen, is_stereo ? DepthSource::stereo : DepthSource::none);
  if (!builder_.isNewKeyframe(seen->time, camera, *map_from_robot)) return;
  builder_.add(seen->time, camera, *map_from_robot, seen->image.view(),
               measuredDepth(observation, rawlogCompanion(file, "_Images")));
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
  mrpt::maps::CSimpleMap simple_map;
  readObject(file, simple_map);
  double done = 0;
  for (const auto& [distribution, frame] : simple_map) {
    if (!distribution || !frame) throw std::runtime_error(file.string() + ": an entry without pose or observations");
    const Rigid3 map_from_robot = toRigid3(distribution->getMeanVal());
    for (const auto& observation : *frame) offer(file, *observation, [&](double) { return map_from_robot; });
    progress(++done / static_cast<double>(simple_map.size()));
  }
}

}  // namespace vmcl
