// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/disturbance.h"

#include <mrpt/core/Clock.h>
#include <mrpt/img/CImage.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace vmcl {
namespace {

using namespace mrpt::obs;

std::vector<mrpt::img::CImage*> imagesOf(CObservation& observation) {
  if (auto* camera = dynamic_cast<CObservationImage*>(&observation)) return {&camera->image};
  if (auto* pair = dynamic_cast<CObservationStereoImages*>(&observation)) return {&pair->imageLeft, &pair->imageRight};
  if (auto* depth_camera = dynamic_cast<CObservation3DRangeScan*>(&observation)) return {&depth_camera->intensityImage};
  return {};
}

void dim(mrpt::img::CImage& image, double light) try {
  image.forceLoad();
  mrpt::img::CImage grey = image.grayscale().makeDeepCopy();
  for (std::size_t row = 0; row < grey.getHeight(); ++row) {
    auto* pixels = grey.ptrLine<uint8_t>(static_cast<unsigned>(row));
    for (std::size_t column = 0; column < grey.getWidth(); ++column)
      pixels[column] = static_cast<uint8_t>(std::lround(light * pixels[column]));
  }
  image = grey;
} catch (const std::exception&) {  // whoever uses the image says what is wrong with it
}

void scale(mrpt::poses::CPose2D& pose, double factor) {
  pose.x(factor * pose.x());
  pose.y(factor * pose.y());
}

void scale(CActionCollection& actions, double factor) {
  for (const auto& action : actions) {
    auto* movement = dynamic_cast<CActionRobotMovement2D*>(action.get_ptr().get());
    if (!movement || movement->estimationMethod != CActionRobotMovement2D::emOdometry) continue;
    mrpt::poses::CPose2D increment = movement->rawOdometryIncrementReading;
    scale(increment, factor);
    movement->computeFromOdometry(increment, movement->motionModelConfiguration);
  }
}

}  // namespace

void Disturbance::check() const {
  const auto require = [](bool good, const char* key, double value) {
    if (!good) throw std::invalid_argument(std::string(key) + " = " + std::to_string(value) + " out of its range");
  };
  require(dropped_images >= 0 && dropped_images < 1, "drop_images", dropped_images);
  require(odometry_scale > 0 && odometry_scale <= 10, "odometry_scale", odometry_scale);
  if (!dimming) return;
  require(dimming->at >= 0 && std::isfinite(dimming->at), "dim.at", dimming->at);
  require(dimming->lasts > 0, "dim.for", dimming->lasts);
  require(dimming->light >= 0 && dimming->light <= 1, "dim.light", dimming->light);
}

DisturbedDrive::DisturbedDrive(const Disturbance& disturbance, uint64_t seed)
    : disturbance_(disturbance), random_(seed, 7) {
  disturbance_.check();
}

bool DisturbedDrive::disturb(CActionCollection* action, CSensoryFrame* frame, CObservation* observation) {
  if (action && disturbance_.odometry_scale != 1) scale(*action, disturbance_.odometry_scale);
  if (frame) {
    for (auto one = frame->begin(); one != frame->end();) one = disturb(**one) ? std::next(one) : frame->erase(one);
  }
  return !observation || disturb(*observation);
}

bool DisturbedDrive::disturb(CObservation& observation) {
  const bool dark = isDim(observation);
  if (auto* odometry = dynamic_cast<CObservationOdometry*>(&observation))
    scale(odometry->odometry, disturbance_.odometry_scale);
  const std::vector<mrpt::img::CImage*> images = imagesOf(observation);
  if (images.empty()) return true;
  if (random_.uniform() < disturbance_.dropped_images) return false;
  if (dark)
    for (mrpt::img::CImage* image : images) dim(*image, disturbance_.dimming->light);
  return true;
}

bool DisturbedDrive::isDim(const CObservation& observation) {
  if (observation.timestamp == INVALID_TIMESTAMP) return false;
  const double time = mrpt::Clock::toDouble(observation.timestamp);
  if (std::isnan(begin_)) begin_ = time;
  const auto& dimming = disturbance_.dimming;
  return dimming && time >= begin_ + dimming->at && time < begin_ + dimming->at + dimming->lasts;
}

}  // namespace vmcl
