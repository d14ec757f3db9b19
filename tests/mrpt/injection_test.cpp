// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "fake_camera_map.h"
#include "filter_setup.h"
#include "vmcl/mrpt/pose_cluster.h"

namespace vmcl {
namespace {

/// The belief before the image, b = (1 - e) p + e u, must come out of the injection as it went in: here p = u.
TEST(Injection, InjectionDoesNotMoveTheBelief) {
  FilterSetup setup;
  setup.options.injection_share = 0.3;
  setup.options.kidnapping_probability = 0;
  const auto inside = [](const PlanarPose& p) { return std::hypot(p.x - 1, p.y) < 0.6; };
  const auto frame = someObservation();
  double drawn = 0, weighed = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    setup.options.seed = static_cast<uint64_t>(seed);
    auto filter = setup.make(box, 40000);
    const PoseMode at_one = mode({1, 0, 0.5}, 0.3);
    filter.update(nullptr, &frame, {&at_one, 1});
    weighed += weightWhere(filter, inside) / 5;
    for (const auto& p : filter.m_particles) drawn += inside({p.d.x, p.d.y, p.d.phi}) / (5.0 * 40000);
  }
  const double expected = std::numbers::pi * 0.36 / 64;
  EXPECT_GT(drawn, 10 * expected);  // the particles did go there
  // 200,000 particles, of which about 3500 lie in the circle by p alone: 2 % standard deviation from those, and as much
  // again from the histogram. A factor of 1.15 is five of both together, false alarm 1e-6; counting the image twice
  // would be a factor of 10.
  EXPECT_NEAR(weighed / expected, 1, 0.15);
}

/// Prior and likelihood Gaussians of equal width: the posterior lies half way, at half the variance. An image that
/// counts twice, by injection and by weight, would give two thirds and a third.
TEST(Injection, AnImageCountsOnce) {
  FilterSetup setup;
  setup.options.injection_share = 0.3;
  setup.options.kidnapping_probability = 0;
  constexpr double deviation = 0.4, seen = 0.6;
  setup.log_likelihood = [](const PlanarPose& p) {
    return -((p.x - seen) * (p.x - seen) + p.y * p.y + p.phi * p.phi) / (2 * deviation * deviation);
  };
  auto filter = setup.make(box, 60000);
  Random random(5);
  for (auto& p : filter.m_particles)
    p.d = {deviation * random.normal(), deviation * random.normal(), deviation * random.normal()};
  const auto frame = someObservation();
  const PoseMode at_seen = mode({seen, 0, 0}, deviation);
  filter.update(nullptr, &frame, {&at_seen, 1});
  const PoseCluster posterior = dominantCluster(filter);
  // Effective sample above 10,000: standard deviations 0.003 of the mean, 1.5 % of the variance; 6.5 of each:
  // false alarm 2e-10 (seed 1 of the filter, 5 of the prior).
  EXPECT_NEAR(posterior.robot_in_map.x, seen / 2, 0.02);
  EXPECT_NEAR(posterior.covariance(0, 0), deviation * deviation / 2, 0.1 * deviation * deviation / 2);
}

/// The image fits as far as `reach` from the truth, six standard deviations of its mode. So all injected particles lie
/// within, and with them nearly all weight and its mean, whatever the seed; without injection there are none.
TEST(Injection, AnImageFindsAKidnappedRobot) {
  FilterSetup setup;
  const PlanarPose truth{3, -2, 1};
  constexpr double reach = 0.3;
  setup.log_likelihood = [&](const PlanarPose& p) {
    return std::hypot(p.x - truth.x, p.y - truth.y) < reach && std::abs(p.phi - truth.phi) < reach ? 30 : 0;
  };
  const auto frame = someObservation();
  const PoseMode at_truth = mode(truth, reach / 6);
  for (const bool injecting : {true, false}) {
    setup.options.injection_share = injecting ? 0.1 : 0;
    auto filter = setup.make({-1, -0.9, 0, 0.1, 0, 0.1}, 1000);
    filter.update(nullptr, &frame, {&at_truth, 1});
    const PoseCluster cluster = dominantCluster(filter);
    EXPECT_EQ(std::hypot(cluster.robot_in_map.x - truth.x, cluster.robot_in_map.y - truth.y) < reach, injecting);
  }
}

/// Of an image that looks, sharply, like one place.
FakeCameraMap aliasedMap(const PlanarPose& looks_like, double radius) {
  return FakeCameraMap([=](const PlanarPose& pose) {
    return std::hypot(pose.x - looks_like.x, pose.y - looks_like.y) < radius ? 3 : 0;
  });
}

TEST(Injection, OneAliasedImageDoesNotMoveTheRobotTwoDo) {
  const PlanarPose looks_like{3, 2, 0};
  const auto maps = mrpt::maps::CMultiMetricMap::Create();
  maps->maps.push_back(std::make_shared<FakeCameraMap>(aliasedMap(looks_like, 0.2)));
  FilterSetup setup;
  setup.filter.BETA = 0.5;
  PlanarMonteCarlo filter(maps, setup.kld, setup.filter, setup.options, PoseRegion(box));
  filter.start(PoseRegion({-1.1, -0.9, -0.1, 0.1, 0, 0.2}), 2000);
  const auto frame = someObservation();
  const PoseMode aliased = mode(looks_like, 0.05);
  const auto moved = [&] { return weightWhere(filter, [](const PlanarPose& p) { return p.x > 2; }); };
  filter.update(nullptr, &frame, {&aliased, 1});
  // Odds of about 0.01 / 0.1. Resampling 2000 particles spreads the share by 0.006: ten of that below, more above.
  EXPECT_GT(moved(), 0.02);
  EXPECT_LT(moved(), 0.2);
  filter.update(nullptr, &frame, {&aliased, 1});
  EXPECT_GT(moved(), 0.9);
}

/// The image fits a disc, 3.1 % of a region that the particles cover, and may be deceptive in one case of ten: those in
/// the disc get 0.9 + 0.1 * 0.031 of the weight.
TEST(Injection, WithoutItOneImageMovesTheRobotNoFarther) {
  const auto maps = mrpt::maps::CMultiMetricMap::Create();
  maps->maps.push_back(std::make_shared<FakeCameraMap>(aliasedMap({0.5, 0.5, 0}, 0.1)));
  FilterSetup setup;
  setup.options.injection_share = 0;
  const PoseRegion region({0, 1, 0, 1, 0, 1});
  PlanarMonteCarlo filter(maps, setup.kld, setup.filter, setup.options, region);
  filter.start(region, 20000);
  const auto frame = someObservation();
  filter.update(nullptr, &frame);
  const double share = weightWhere(filter, [](const PlanarPose& p) { return std::hypot(p.x - 0.5, p.y - 0.5) < 0.1; });
  // The histogram leaks a twentieth at the ends of the headings. 628 particles lie in the disc, give or take 25; by all
  // of them the share would change by 0.003.
  EXPECT_NEAR(share, 0.903, 0.02);
}

TEST(Injection, WeightsThatUnderflowDoNoHarm) {
  const auto maps = mrpt::maps::CMultiMetricMap::Create();
  maps->maps.push_back(std::make_shared<FakeCameraMap>(aliasedMap({0, 0, 0}, 0.1)));
  FilterSetup setup;
  PlanarMonteCarlo filter(maps, setup.kld, setup.filter, setup.options, PoseRegion(box));
  filter.start(PoseRegion(box), 100);
  filter.m_particles[0].log_w = -2000;
  const auto frame = someObservation();
  filter.update(nullptr, &frame);
  for (const auto& particle : filter.m_particles) EXPECT_TRUE(std::isfinite(particle.log_w));
}

/// One particle holds nearly all the weight, and half of them are replaced: at even odds it would be among those.
/// Twenty runs would let that pass once in a million. Of the rest five or more would have to be drawn among the 50 that
/// stay, 0.05 are expected: false alarm of all 20 runs 5e-8.
TEST(Injection, DoesNotDropTheParticleWithTheWeight) {
  const auto frame = someObservation();
  const PoseMode elsewhere = mode({3, 3, 0}, 0.1);
  for (const bool adaptive : {false, true})
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      FilterSetup setup;
      setup.filter.adaptiveSampleSize = adaptive;  // draws particles anew only when the robot moves
      setup.options.injection_share = 0.5;
      setup.options.kidnapping_probability = 0;
      setup.options.seed = seed;
      auto filter = setup.make({-1, -1, -1, -1, 0, 0}, 100);
      for (auto& particle : filter.m_particles) particle.log_w = std::log(0.001 / 99);
      filter.m_particles[7].log_w = std::log(0.999);
      filter.m_particles[7].d = {1, 1, 0};
      filter.update(nullptr, &frame, {&elsewhere, 1});
      EXPECT_GT(weightWhere(filter, [](const PlanarPose& p) { return p.x == 1; }), 0.9) << seed;
    }
}

}  // namespace
}  // namespace vmcl
