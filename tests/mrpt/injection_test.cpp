// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "filter_setup.h"
#include "vmcl/mrpt/pose_cluster.h"
#include "vmcl/mrpt/relocalizing_map.h"

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
  // again from the histogram. A factor of 1.15 is seven of them; counting the image twice would be a factor of 10.
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
  // Effective sample above 10,000: standard deviations 0.003 of the mean, 1.5 % of the variance; seven of each.
  EXPECT_NEAR(posterior.robot_in_map.x, seen / 2, 0.02);
  EXPECT_NEAR(posterior.covariance(0, 0), deviation * deviation / 2, 0.1 * deviation * deviation / 2);
}

TEST(Injection, AnImageFindsAKidnappedRobot) {
  FilterSetup setup;
  const PlanarPose truth{3, -2, 1};
  setup.log_likelihood = [&](const PlanarPose& p) {
    return std::hypot(p.x - truth.x, p.y - truth.y) < 0.3 && std::abs(p.phi - truth.phi) < 0.3 ? 30 : 0;
  };
  const auto frame = someObservation();
  const PoseMode at_truth = mode(truth, 0.05);
  for (const bool injecting : {true, false}) {
    setup.options.injection_share = injecting ? 0.1 : 0;
    auto filter = setup.make({-1, -0.9, 0, 0.1, 0, 0.1}, 1000);
    filter.update(nullptr, &frame, {&at_truth, 1});
    const PoseCluster cluster = dominantCluster(filter);
    EXPECT_EQ(std::hypot(cluster.robot_in_map.x - truth.x, cluster.robot_in_map.y - truth.y) < 0.1, injecting);
  }
}

/// A map with a camera whose image looks, sharply, like another place than where the particles are.
class AliasedMap : public FakeMap, public RelocalizingMap {
 public:
  explicit AliasedMap(const PlanarPose& looks_like)
      : FakeMap([](const PlanarPose&) { return 0; }), looks_like_(looks_like) {}

  void addLogLikelihoods(const mrpt::obs::CObservation&, std::span<const PlanarPose> poses, int,
                         std::span<double> log_likelihoods) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double distance = std::hypot(poses[i].x - looks_like_.x, poses[i].y - looks_like_.y);
      log_likelihoods[i] += 60 * std::exp(-distance * distance / 0.02);
    }
  }
  PoseEstimate relocalize(const mrpt::obs::CObservation&) const override { return {{mode(looks_like_, 0.05)}, ""}; }
  void extend(PoseBox&) const override {}

 private:
  PlanarPose looks_like_;
};

TEST(Injection, OneAliasedImageDoesNotMoveTheRobotTwoDo) {
  const PlanarPose looks_like{3, 2, 0};
  const auto maps = mrpt::maps::CMultiMetricMap::Create();
  maps->maps.push_back(std::make_shared<AliasedMap>(looks_like));
  FilterSetup setup;
  setup.filter.BETA = 0.5;
  PlanarMonteCarlo filter(maps, setup.kld, setup.filter, setup.options, PoseRegion(box));
  filter.start(PoseRegion({-1.1, -0.9, -0.1, 0.1, 0, 0.2}), 2000);
  const auto frame = someObservation();
  const PoseMode aliased = mode(looks_like, 0.05);
  const auto moved = [&] { return weightWhere(filter, [](const PlanarPose& p) { return p.x > 2; }); };
  filter.update(nullptr, &frame, {&aliased, 1});
  EXPECT_GT(moved(), 0.02);  // odds of about 0.01 / 0.1
  EXPECT_LT(moved(), 0.2);
  filter.update(nullptr, &frame, {&aliased, 1});
  EXPECT_GT(moved(), 0.9);
}

}  // namespace
}  // namespace vmcl
