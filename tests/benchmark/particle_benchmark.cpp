// SPDX-License-Identifier: BSD-3-Clause
// Time that one particle's weight takes (the inverse of items_per_second), by an image of 200 matches and by a laser
// scan in MRPT's likelihood field with AMCL-like settings (361 rays, one of 20 used), and the ratio of the two.
#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <chrono>
#include <vector>

#include "random_scene.h"
#include "vmcl/mrpt/image_measurements.h"

namespace vmcl {
namespace {

constexpr int particles = 2000;

std::vector<PlanarPose> posesAbout(const PlanarPose& truth) {
  Random random(2);
  std::vector<PlanarPose> poses;
  for (int i = 0; i < particles; ++i)
    poses.push_back(
        {truth.x + 0.05 * random.normal(), truth.y + 0.05 * random.normal(), truth.phi + 0.02 * random.normal()});
  return poses;
}

struct Camera {
  Camera() {
    Random random(1);
    const Scene scene = randomScene(
        random, {.matches = 200, .outlier_rate = 0.5, .depth_rate = 0.5, .noise_px = 2, .point_sigma = 0.02});
    image.problem = scene.problem;
    image.likelihood.emplace(scene.problem, LikelihoodOptions{});
    poses = posesAbout(scene.map_from_robot);
    values.resize(poses.size());
  }

  void weigh() { image.addLogLikelihoods(poses, values); }

  ImageMeasurement image;
  std::vector<PlanarPose> poses;
  std::vector<double> values;
};

/// In the middle of a room of 8 m x 6 m.
struct Laser {
  Laser() : grid(-5, 5, -4, 4, 0.05F) {
    grid.fill(0.9F);
    for (float x = -4; x <= 4; x += 0.05F)
      for (const float y : {-3.0F, 3.0F}) grid.setPos(x, y, 0);
    for (float y = -3; y <= 3; y += 0.05F)
      for (const float x : {-4.0F, 4.0F}) grid.setPos(x, y, 0);
    grid.likelihoodOptions.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
    grid.likelihoodOptions.LF_decimation = 20;
    scan.aperture = static_cast<float>(M_PI);
    scan.maxRange = 20;
    grid.laserScanSimulator(scan, mrpt::poses::CPose2D(0, 0, 0), 0.5F, 361);
    for (const PlanarPose& pose : posesAbout({}))
      poses.emplace_back(mrpt::math::TPose3D(pose.x, pose.y, 0, pose.phi, 0, 0));
    values.resize(poses.size());
  }

  void weigh() {
    for (std::size_t i = 0; i < poses.size(); ++i) values[i] += grid.computeObservationLikelihood(scan, poses[i]);
  }

  mrpt::maps::COccupancyGridMap2D grid;
  mrpt::obs::CObservation2DRangeScan scan;
  std::vector<mrpt::poses::CPose3D> poses;
  std::vector<double> values;
};

template <typename Sensor>
void weight(benchmark::State& state) {
  Sensor sensor;
  for (auto _ : state) sensor.weigh();
  state.SetItemsProcessed(state.iterations() * particles);
}
BENCHMARK(weight<Camera>)->Unit(benchmark::kMicrosecond);
BENCHMARK(weight<Laser>)->Unit(benchmark::kMicrosecond);

/// By turns, so that the machine's other work slows both.
void cameraOverLaser(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  Camera camera;
  Laser laser;
  Clock::duration of_camera{}, of_laser{};
  for (auto _ : state) {
    const auto begin = Clock::now();
    camera.weigh();
    const auto middle = Clock::now();
    laser.weigh();
    of_camera += middle - begin;
    of_laser += Clock::now() - middle;
  }
  state.counters["ratio"] = static_cast<double>(of_camera.count()) / static_cast<double>(of_laser.count());
}
BENCHMARK(cameraOverLaser)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace vmcl
