// SPDX-License-Identifier: BSD-3-Clause
#include "map_frames.h"

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <stdexcept>

#include "../stereo_observation.h"

namespace vmcl {
namespace {

constexpr double frame_way = 0.15, frame_turn = 8 * degree;

/// With its images inside.
mrpt::obs::CObservation::Ptr observationOf(const CameraShot& shot) {
  const mrpt::img::CImage image(shot.bgr, mrpt::img::DEEP_COPY);
  if (!shot.right_bgr.empty()) {
    const auto pair =
        mrpt::obs::CObservationStereoImages::Create(stereoObservation(shot.observation, shot.stereo_baseline));
    pair->imageLeft = image;
    pair->imageRight = mrpt::img::CImage(shot.right_bgr, mrpt::img::DEEP_COPY);
    return pair;
  }
  const auto camera = mrpt::obs::CObservationImage::Create(shot.observation);
  camera->image = image;
  return camera;
}

}  // namespace

bool MapFrames::isDue(const std::string& camera, const PlanarPose& map_from_robot) const {
  const auto last = last_.find(camera);
  if (last == last_.end()) return true;
  const PlanarPose motion = inverse(last->second) * map_from_robot;
  return std::hypot(motion.x, motion.y) >= frame_way || std::abs(motion.phi) >= frame_turn;
}

void MapFrames::add(const PlanarPose& map_from_robot, const CameraShot& shot,
                    const std::optional<mrpt::obs::CObservation2DRangeScan>& laser) {
  last_[shot.observation.sensorLabel] = map_from_robot;
  const auto frame = mrpt::obs::CSensoryFrame::Create();
  if (laser) frame->insert(mrpt::obs::CObservation2DRangeScan::Create(*laser));
  frame->insert(observationOf(shot));
  const auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
  pose->mean = mrpt::poses::CPose3D(map_from_robot.x, map_from_robot.y, 0, map_from_robot.phi, 0, 0);
  map_.insert(pose, frame);
}

void MapFrames::save(AtomicFile& file) const {
  const bool raw_images = mrpt::img::CImage::DISABLE_JPEG_COMPRESSION();
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);  // a quarter of the size
  const bool saved = map_.saveToFile(file.temporaryPath());
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(raw_images);
  if (!saved) throw std::runtime_error(file.temporaryPath().string() + ": cannot be written");
  file.commit();
}

}  // namespace vmcl
