// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/random.h>

#include "filter_setup.h"
#include "vmcl/mrpt/pose_cluster.h"

namespace vmcl {
namespace {

using mrpt::bayes::CParticleFilter;

TEST(PlanarMonteCarlo, MovesWithTheOdometry) {
  auto filter = FilterSetup().make({0, 0, 0, 0, 0, 0}, 2000);
  const auto action = movement(1.0, 0.3);
  filter.update(&action, nullptr);
  const PoseCluster cluster = dominantCluster(filter);
  // MRPT's default noise is about 2 cm and 2 deg here: the mean of 2000 particles is known to 0.5 mm and 0.8 mrad, so
  // that a false alarm takes 25 standard deviations.
  EXPECT_NEAR(cluster.robot_in_map.x, 1, 0.02);
  EXPECT_NEAR(cluster.robot_in_map.phi, 0.3, 0.02);
  EXPECT_GT(cluster.headingDeviation(), 0);
}

/// 20,000 particles that were at the origin, after a movement without noise where one in five slips.
PlanarMonteCarlo afterSlips(const mrpt::poses::CPose2D& movement) {
  FilterSetup setup;
  setup.options.slip_probability = 0.2;
  auto filter = setup.make({0, 0, 0, 0, 0, 0}, 20000);
  mrpt::obs::CActionRobotMovement2D exact;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions noiseless;
  noiseless.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  noiseless.gaussianModel = {};
  noiseless.gaussianModel.a1 = noiseless.gaussianModel.a2 = noiseless.gaussianModel.a3 = noiseless.gaussianModel.a4 = 0;
  noiseless.gaussianModel.minStdXY = noiseless.gaussianModel.minStdPHI = 1e-6;
  exact.computeFromOdometry(movement, noiseless);
  mrpt::obs::CActionCollection action;
  action.insert(exact);
  filter.update(&action, nullptr);
  return filter;
}

TEST(PlanarMonteCarlo, SomeParticlesMoveAsIfAWheelHadSlipped) {
  const auto filter = afterSlips({0.3, 0, 0});
  // Up to half of 0.3 m, over 0.3 m between the wheels: up to 0.5 rad, to either side, and back by half as much.
  const auto turned = [](double low, double high) {
    return [=](const PlanarPose& p) { return low < p.phi && p.phi < high; };
  };
  // Five and more standard deviations of the numbers of particles: false alarm 2e-6.
  EXPECT_NEAR(weightWhere(filter, turned(-1e-4, 1e-4)), 0.8, 0.015);
  EXPECT_NEAR(weightWhere(filter, turned(1e-4, 0.5001)), 0.1, 0.011);
  EXPECT_NEAR(weightWhere(filter, turned(-0.5001, -1e-4)), 0.1, 0.011);
  EXPECT_NEAR(weightWhere(filter, turned(0.25, 0.5001)), 0.05, 0.008);
  for (const auto& particle : filter.m_particles)
    EXPECT_NEAR(particle.d.x, 0.3 - 0.15 * std::abs(particle.d.phi), 1e-3);
}

TEST(PlanarMonteCarlo, SlippingWheelsTurnTooFarTheWayTheyTurn) {
  for (const auto& particle : afterSlips({-0.3, 0, 0}).m_particles)
    EXPECT_NEAR(particle.d.x, -0.3 + 0.15 * std::abs(particle.d.phi), 1e-3);
  const auto on_the_spot = afterSlips({0, 0, 1});
  for (const auto& particle : on_the_spot.m_particles) {
    EXPECT_LT(particle.d.phi, 1 + 1e-4);
    EXPECT_GT(particle.d.phi, 0.75 - 1e-4);
  }
  // Five standard deviations and more of the number of particles: false alarm 1e-6.
  EXPECT_NEAR(weightWhere(on_the_spot, [](const PlanarPose& p) { return p.phi < 1 - 1e-4; }), 0.2, 0.015);
}

TEST(PlanarMonteCarlo, WeighsByTheLikelihood) {
  FilterSetup setup;
  setup.log_likelihood = [](const PlanarPose& pose) { return pose.x > 0 ? std::log(3.0) : 0; };
  auto filter = setup.make(box, 20000);
  const auto frame = someObservation();
  filter.update(nullptr, &frame);
  // Shares 3 to 1; six standard deviations of the number of particles on each side: false alarm 2e-9.
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

/// All poses are as likely, and when the likelihood drops the filter scatters particles.
struct RecoveringSetup : FilterSetup {
  double level = 0;  ///< log likelihood of any pose

  RecoveringSetup() {
    options.recovery_alpha_slow = 0.001;
    options.recovery_alpha_fast = 0.5;
    log_likelihood = [this](const PlanarPose&) { return level; };
  }
};

TEST(PlanarMonteCarlo, RecoversWithRandomParticlesWhenTheLikelihoodDrops) {
  RecoveringSetup setup;
  auto filter = setup.make({0, 0, 0, 0, 0, 0}, 1000);
  const auto frame = someObservation();
  const auto elsewhere = [](const PlanarPose& p) { return std::hypot(p.x, p.y) > 0.1; };
  filter.update(nullptr, &frame);
  filter.update(nullptr, &frame);
  EXPECT_EQ(weightWhere(filter, elsewhere), 0);
  setup.level = -5;
  filter.update(nullptr, &frame);  // the averages notice
  filter.update(nullptr, &frame);  // and act: w_slow = 0.999, w_fast = 0.503
  // Of 496 random particles 0.24 lie within 0.1 m of the origin, six or more with a chance of 2e-7.
  EXPECT_NEAR(weightWhere(filter, elsewhere), 1 - 0.50337 / 0.99901, 0.0057);
}

TEST(PlanarMonteCarlo, LikelihoodsBeforeAStartOrOfAnotherMapDoNotCount) {
  RecoveringSetup setup;
  const auto frame = someObservation();
  const PoseRegion origin({0, 0, 0, 0, 0, 0});
  const auto elsewhere = [](const PlanarPose& p) { return std::hypot(p.x, p.y) > 0.1; };
  for (const bool restarted : {true, false}) {
    setup.level = 0;
    auto filter = setup.make({0, 0, 0, 0, 0, 0}, 1000);
    filter.update(nullptr, &frame);
    setup.level = -5;
    filter.update(nullptr, &frame);  // the averages notice
    if (restarted)
      filter.start(origin, 1000);
    else
      filter.setMap(setup.maps(), PoseRegion(box));
    filter.update(nullptr, &frame);
    EXPECT_EQ(weightWhere(filter, elsewhere), 0) << restarted;
  }
}

TEST(PlanarMonteCarlo, StaysWhereItIsInAMapOfNoKnownExtent) {
  RecoveringSetup setup;
  PlanarMonteCarlo filter(setup.maps(), setup.kld, setup.filter, setup.options, PoseRegion(PoseBox{}));
  filter.start(PoseRegion({3, 3, 2, 2, 1, 1}), 100);
  const auto before = numbersOf(filter);
  const auto frame = someObservation();
  for (setup.level = 0; setup.level > -10; --setup.level) filter.update(nullptr, &frame);
  filter.scatterAnywhere(0.5);
  EXPECT_EQ(numbersOf(filter), before);
}

/// Draws in every way: motion noise, sample size, injection, resampling.
struct DrawingSetup : FilterSetup {
  DrawingSetup() {
    filter.adaptiveSampleSize = true;
    filter.resamplingMethod = CParticleFilter::prMultinomial;
    kld.KLD_maxSampleSize = 2000;
    log_likelihood = [](const PlanarPose& p) { return -p.x * p.x; };
  }

  PlanarMonteCarlo make(uint64_t seed) {
    options.seed = seed;
    return FilterSetup::make(box, 1000);
  }

  static void drive(PlanarMonteCarlo& driven) {
    const auto frame = someObservation();
    const auto action = movement(0.1, 0.1);
    const PoseMode somewhere = mode({1, 1, 1}, 0.1);
    driven.update(&action, &frame, {&somewhere, 1});
  }

  std::vector<double> run(uint64_t seed) {
    auto fresh = make(seed);
    for (int i = 0; i < 5; ++i) drive(fresh);
    return numbersOf(fresh);
  }
};

TEST(PlanarMonteCarlo, SameSeedSameParticles) {
  DrawingSetup setup;
  EXPECT_EQ(setup.run(1), setup.run(1));
  EXPECT_NE(setup.run(1), setup.run(2));
}

TEST(PlanarMonteCarlo, FiltersThatTakeTurnsAreAsIfAlone) {
  DrawingSetup setup;
  auto first = setup.make(1), second = setup.make(2);
  for (int i = 0; i < 5; ++i) {
    setup.drive(first);
    setup.drive(second);
  }
  EXPECT_EQ(numbersOf(first), setup.run(1));
  EXPECT_EQ(numbersOf(second), setup.run(2));
}

TEST(PlanarMonteCarlo, LeavesTheGeneratorOfTheProcessAsItWas) {
  DrawingSetup setup;
  auto& generator = mrpt::random::getRandomGenerator();
  generator.randomize(5);
  const auto expected = generator.drawUniform64bit();
  generator.randomize(5);
  setup.run(1);
  EXPECT_EQ(generator.drawUniform64bit(), expected);
}

TEST(PlanarMonteCarlo, RefusesALikelihoodThatIsNotFinite) {
  FilterSetup setup;
  setup.log_likelihood = [](const PlanarPose&) { return std::nan(""); };
  auto filter = setup.make(box, 10);
  const auto before = numbersOf(filter);
  const auto frame = someObservation();
  const PoseMode somewhere = mode({1, 1, 1}, 0.1);
  EXPECT_THROW(filter.update(nullptr, &frame, {&somewhere, 1}), std::runtime_error);
  EXPECT_EQ(numbersOf(filter), before);
}

TEST(PlanarMonteCarlo, RefusesBadOptions) {
  const auto refuses = [](auto&& change) {
    FilterSetup setup;
    change(setup);
    EXPECT_THROW(setup.make(box, 10), std::invalid_argument);
  };
  refuses([](FilterSetup& s) { s.options.injection_share = 1; });
  refuses([](FilterSetup& s) { s.options.injection_share = std::nan(""); });
  refuses([](FilterSetup& s) { s.options.slip_probability = 0.6; });
  refuses([](FilterSetup& s) { s.options.kidnapping_probability = -0.1; });
  refuses([](FilterSetup& s) { s.options.recovery_alpha_fast = 2; });
  refuses([](FilterSetup& s) { s.options.aliasing_probability = 1; });
  refuses([](FilterSetup& s) { s.options.threads = 0; });
  refuses([](FilterSetup& s) { s.filter.BETA = std::nan(""); });
  refuses([](FilterSetup& s) { s.filter.powFactor = 0; });
  refuses([](FilterSetup& s) { s.filter.PF_algorithm = CParticleFilter::pfOptimalProposal; });
  refuses([](FilterSetup& s) {
    s.filter.adaptiveSampleSize = true;
    s.filter.resamplingMethod = CParticleFilter::prSystematic;
  });
  EXPECT_THROW(FilterSetup().make(box, 0), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
