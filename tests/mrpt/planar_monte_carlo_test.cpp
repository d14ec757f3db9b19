// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/planar_monte_carlo.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>

#include "fake_map.h"
#include "vmcl/mrpt/pose_cluster.h"
#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {
namespace {

using mrpt::bayes::CParticleFilter;

constexpr PoseBox box{-4, 4, -4, 4};

/// A filter with one fake map and a fixed sample size.
struct FilterSetup {
  PlanarMonteCarloOptions options;
  PlanarMonteCarlo::ParticleFilterOptions filter;
  PlanarMonteCarlo::KldOptions kld;
  std::function<double(const PlanarPose&)> log_likelihood = [](const PlanarPose&) { return 0; };

  FilterSetup() {
    filter.adaptiveSampleSize = false;
    filter.BETA = 0;  // no resampling, so that weights can be looked at
  }

  PlanarMonteCarlo make(const PoseBox& start, int particles) const {
    auto maps = mrpt::maps::CMultiMetricMap::Create();
    maps->maps.push_back(std::make_shared<FakeMap>(log_likelihood));
    PlanarMonteCarlo filtered(maps, kld, filter, options, PoseRegion(box));
    filtered.start(PoseRegion(start), particles);
    return filtered;
  }
};

mrpt::obs::CSensoryFrame someObservation() {
  mrpt::obs::CSensoryFrame frame;
  frame.insert(mrpt::obs::CObservationComment::Create());
  return frame;
}

mrpt::obs::CActionCollection movement(double x, double phi) {
  mrpt::obs::CActionRobotMovement2D action;
  action.computeFromOdometry(mrpt::poses::CPose2D(x, 0, phi), {});
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  return actions;
}

PoseMode mode(const PlanarPose& pose, double deviation) {
  PoseMode one;
  one.robot_in_map = pose;
  one.covariance = Eigen::Vector3d::Constant(deviation * deviation).asDiagonal();
  return one;
}

template <typename Inside>
double weightWhere(const PlanarMonteCarlo& filter, Inside&& inside) {
  double weight = 0, total = 0;
  for (const auto& particle : filter.m_particles) {
    const double w = std::exp(particle.log_w);
    total += w;
    if (inside(PlanarPose{particle.d.x, particle.d.y, particle.d.phi})) weight += w;
  }
  return weight / total;
}

std::vector<double> numbersOf(const PlanarMonteCarlo& filter) {
  std::vector<double> numbers;
  for (const auto& p : filter.m_particles) numbers.insert(numbers.end(), {p.d.x, p.d.y, p.d.phi, p.log_w});
  return numbers;
}

TEST(PlanarMonteCarlo, MovesWithTheOdometry) {
  auto filter = FilterSetup().make({0, 0, 0, 0, 0, 0}, 2000);
  const auto action = movement(1.0, 0.3);
  filter.update(&action, nullptr);
  const PoseCluster cluster = dominantCluster(filter);
  // MRPT's default noise is about 2 cm and 2 deg here, its mean over 2000 particles far below the tolerance.
  EXPECT_NEAR(cluster.robot_in_map.x, 1, 0.02);
  EXPECT_NEAR(cluster.robot_in_map.phi, 0.3, 0.02);
  EXPECT_GT(cluster.headingDeviation(), 0);
}

TEST(PlanarMonteCarlo, WeighsByTheLikelihood) {
  FilterSetup setup;
  setup.log_likelihood = [](const PlanarPose& pose) { return pose.x > 0 ? std::log(3.0) : 0; };
  auto filter = setup.make(box, 20000);
  const auto frame = someObservation();
  filter.update(nullptr, &frame);
  // Shares 3 to 1; six standard deviations of the number of particles on each side.
  EXPECT_NEAR(weightWhere(filter, [](const PlanarPose& p) { return p.x > 0; }), 0.75, 0.02);
}

TEST(PlanarMonteCarlo, WeightsAreEqualAfterResampling) {
  FilterSetup setup;
  setup.filter.BETA = 1;
  setup.log_likelihood = [](const PlanarPose& pose) { return -pose.x * pose.x; };
  auto filter = setup.make(box, 500);
  const auto frame = someObservation();
  filter.update(nullptr, &frame);
  EXPECT_LT(filter.effectiveShare(), 0.9);
  for (const auto& particle : filter.m_particles) EXPECT_DOUBLE_EQ(particle.log_w, -std::log(500.0));
}

/// The belief before the image, b = (1 - e) p + e u, must come out of the injection as it went in: here p = u.
TEST(PlanarMonteCarlo, InjectionDoesNotMoveTheBelief) {
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
TEST(PlanarMonteCarlo, AnImageCountsOnce) {
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

TEST(PlanarMonteCarlo, AnImageFindsAKidnappedRobot) {
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

TEST(PlanarMonteCarlo, OneAliasedImageDoesNotMoveTheRobotTwoDo) {
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

TEST(PlanarMonteCarlo, RecoversWithRandomParticlesWhenTheLikelihoodDrops) {
  FilterSetup setup;
  setup.options.recovery_alpha_slow = 0.001;
  setup.options.recovery_alpha_fast = 0.5;
  double level = 0;
  setup.log_likelihood = [&](const PlanarPose&) { return level; };
  auto filter = setup.make({0, 0, 0, 0, 0, 0}, 1000);
  const auto frame = someObservation();
  const auto elsewhere = [](const PlanarPose& p) { return std::hypot(p.x, p.y) > 0.1; };
  filter.update(nullptr, &frame);
  filter.update(nullptr, &frame);
  EXPECT_EQ(weightWhere(filter, elsewhere), 0);
  level = -5;
  filter.update(nullptr, &frame);  // the averages notice
  filter.update(nullptr, &frame);  // and act: w_slow = 0.999, w_fast = 0.503
  EXPECT_NEAR(weightWhere(filter, elsewhere), 1 - 0.50337 / 0.99901, 0.002);
}

TEST(PlanarMonteCarlo, SameSeedSameParticles) {
  FilterSetup setup;
  setup.filter.adaptiveSampleSize = true;
  setup.filter.resamplingMethod = CParticleFilter::prMultinomial;
  setup.kld.KLD_maxSampleSize = 2000;
  setup.log_likelihood = [](const PlanarPose& p) { return -p.x * p.x; };
  const auto run = [&](uint64_t seed) {
    setup.options.seed = seed;
    auto filter = setup.make(box, 1000);
    const auto frame = someObservation();
    const auto action = movement(0.1, 0.1);
    const PoseMode somewhere = mode({1, 1, 1}, 0.1);
    for (int i = 0; i < 5; ++i) filter.update(&action, &frame, {&somewhere, 1});
    return numbersOf(filter);
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(PlanarMonteCarlo, RefusesALikelihoodThatIsNotFinite) {
  FilterSetup setup;
  setup.log_likelihood = [](const PlanarPose&) { return std::nan(""); };
  auto filter = setup.make(box, 10);
  const auto frame = someObservation();
  EXPECT_THROW(filter.update(nullptr, &frame), std::runtime_error);
}

TEST(PlanarMonteCarlo, RefusesBadOptions) {
  const auto refuses = [](auto&& change) {
    FilterSetup setup;
    change(setup);
    EXPECT_THROW(setup.make(box, 10), std::invalid_argument);
  };
  refuses([](FilterSetup& s) { s.options.injection_share = 1; });
  refuses([](FilterSetup& s) { s.options.injection_share = std::nan(""); });
  refuses([](FilterSetup& s) { s.options.kidnapping_probability = -0.1; });
  refuses([](FilterSetup& s) { s.options.recovery_alpha_fast = 2; });
  refuses([](FilterSetup& s) { s.options.aliasing_probability = 1; });
  refuses([](FilterSetup& s) { s.options.threads = 0; });
  refuses([](FilterSetup& s) {
    s.filter.adaptiveSampleSize = true;
    s.filter.resamplingMethod = CParticleFilter::prSystematic;
  });
  EXPECT_THROW(FilterSetup().make(box, 0), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
