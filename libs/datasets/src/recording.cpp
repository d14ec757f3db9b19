// SPDX-License-Identifier: BSD-3-Clause
#include "recording.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "depth_observation.h"

namespace vmcl {
namespace {

constexpr double patience = 1.0;      // s that readings may come late
constexpr double same_moment = 0.02;  // s between colour and depth of one shot
constexpr double latest_time = 1e10;  // s, the year 2286; a rawlog's clock overflows later
constexpr std::size_t max_clock_problems = 20;

}  // namespace

DriveRecording::DriveRecording(const std::filesystem::path& log, const mrpt::obs::CObservationImage& camera)
    : log_(log), camera_(camera), writer_(log) {}

bool DriveRecording::isInOrder(const std::string& sensor, double time, const std::string& place) {
  const auto [last, is_first] = last_time_.try_emplace(sensor, -1);
  const bool is_valid = time >= 0 && time <= latest_time;
  const bool is_late = written_until_ > 0 && time < written_until_;
  if (is_valid && time > last->second && !is_late) {
    last->second = time;
    return true;
  }
  if (report_.problems.size() < max_clock_problems)
    report_.problems.push_back(place + ": " + (is_valid ? "the clock runs backwards to " : "no time stamp but ") +
                               std::to_string(time) + " s");
  return false;
}

void DriveRecording::schedule(double time, std::function<void()> write) {
  waiting_.emplace(time, std::move(write));
  writeUntil(waiting_.rbegin()->first - patience);
}

void DriveRecording::writeUntil(double time) {
  while (!waiting_.empty() && waiting_.begin()->first <= time) {
    const auto first = waiting_.begin();
    written_until_ = first->first;
    first->second();
    waiting_.erase(first);
  }
  depth_images_.erase(depth_images_.begin(), depth_images_.lower_bound(written_until_ - patience));
}

void DriveRecording::addImage(double time, std::string encoded, const std::string& extension,
                              const std::string& place) {
  if (!isInOrder("colour", time, place)) return;
  const auto image = std::make_shared<Image>(Image{std::move(encoded), extension});
  schedule(time, [this, time, image] { writeImage(time, *image); });
}

void DriveRecording::addDepth(double time, const cv::Mat& millimetres, const std::string& place) {
  if (isInOrder("depth", time, place)) depth_images_[time] = millimetres;
}

void DriveRecording::writeImage(double time, const Image& image) {
  mrpt::obs::CObservationImage observation = camera_;
  observation.timestamp = mrpt::Clock::fromDouble(time);
  ++report_.images;
  auto nearest = depth_images_.lower_bound(time - same_moment);
  for (auto i = nearest; i != depth_images_.end() && i->first <= time + same_moment; ++i)
    if (std::abs(i->first - time) < std::abs(nearest->first - time)) nearest = i;
  if (nearest == depth_images_.end() || std::abs(nearest->first - time) > same_moment) {
    writer_.write(observation, image.encoded, image.extension);
    return;
  }
  ++report_.depth_images;
  writer_.write(depthObservation(observation, nearest->second), image.encoded, image.extension);
}

void DriveRecording::addOdometry(double time, const Rigid3& odom_from_robot, const std::string& place) {
  if (!isInOrder("odometry", time, place)) return;
  schedule(time, [this, time, planar = planarPart(odom_from_robot)] {
    mrpt::obs::CObservationOdometry observation;
    observation.sensorLabel = "odometry";
    observation.timestamp = mrpt::Clock::fromDouble(time);
    observation.odometry = mrpt::poses::CPose2D(planar.x, planar.y, planar.phi);
    writer_.write(observation);
    ++report_.odometry_readings;
  });
}

void DriveRecording::addScan(double time, const mrpt::obs::CObservation2DRangeScan& scan, const std::string& place) {
  if (!isInOrder("laser", time, place)) return;
  const auto kept = std::make_shared<mrpt::obs::CObservation2DRangeScan>(scan);
  kept->timestamp = mrpt::Clock::fromDouble(time);
  schedule(time, [this, kept] {
    writer_.write(*kept);
    ++report_.scans;
  });
}

void DriveRecording::addTruth(double time, const Rigid3& map_from_robot, const std::string& place) {
  const auto [last, is_first] = last_time_.try_emplace("truth", -1);
  if (time > last->second && time <= latest_time) {
    last->second = time;
    truth_.push_back({time, map_from_robot});
  } else if (report_.problems.size() < max_clock_problems) {
    report_.problems.push_back(place + ": the clock runs backwards to " + std::to_string(time) + " s");
  }
}

ImportReport DriveRecording::finish(const std::string& source) {
  if (!waiting_.empty()) writeUntil(waiting_.rbegin()->first);
  if (report_.images == 0)
    throw std::runtime_error(report_.problems.empty() ? source + ": no image to import" : report_.problems.front());
  if (!truth_.empty()) writeTumTrajectory(rawlogCompanion(log_, ".groundtruth.tum"), Trajectory(truth_));
  writer_.commit();
  report_.ground_truth_poses = static_cast<int>(truth_.size());
  return report_;
}

}  // namespace vmcl
