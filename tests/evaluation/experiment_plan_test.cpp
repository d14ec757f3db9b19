// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/experiment_plan.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "experiment_files.h"

namespace vmcl {
namespace {

using testing::HasSubstr;

class ExperimentPlanTest : public ExperimentFiles {
 protected:
  Experiment read(const std::string& text) const { return readExperiment(write("plan.yaml", text)); }
};

TEST_F(ExperimentPlanTest, EveryCombinationIsARunOrSkipped) {
  const ExperimentPlan plan = planExperiment(read(good_));
  // Laser: 3 starts, 2 configurations, 3 seeds. Odometry: only from the given start.
  ASSERT_EQ(plan.jobs.size(), 24U);
  EXPECT_EQ(plan.jobs[0].id, "query.laser.laser.given.1");
  EXPECT_EQ(plan.jobs[23].id, "query.laser.few.kidnapped-at-2s-for-1.5s.3");
  ASSERT_EQ(plan.skipped.size(), 4U);
  EXPECT_EQ(plan.skipped[0].name, "query.odometry.laser.global");
  EXPECT_EQ(plan.skipped[0].reason, "odometry alone does not tell where the robot starts");
  EXPECT_EQ(plan.skipped[2].reason, "odometry alone does not tell where the robot was put");
}

TEST_F(ExperimentPlanTest, SkipsSensorsWithoutAMap) {
  const ExperimentPlan plan = planExperiment(read(with("[laser, odometry]", "[laser, camera, both]")));
  ASSERT_EQ(plan.jobs.size(), 18U);
  for (const auto& skipped : plan.skipped) EXPECT_THAT(skipped.reason, HasSubstr("no map for a camera"));
  write("rooms.vmap", "another map");
  const std::string no_grid = with("rooms.simplemap", "rooms.vmap");
  try {
    planExperiment(read(no_grid.substr(0, no_grid.find("starts")) + "starts: [global]\nseeds: 1\n"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("plan.yaml: no combination makes sense: query.laser.laser.global: there is no"));
  }
}

TEST_F(ExperimentPlanTest, StartsAtEachOfTheTimes) {
  const Experiment experiment = read(with("seeds: 3", "start_times: [0, 2.5, 11]\nseeds: 1"));
  const ExperimentPlan plan = planExperiment(experiment);
  const auto job = std::find_if(plan.jobs.begin(), plan.jobs.end(),
                                [](const Job& j) { return j.id == "query.laser.laser.global-after-2.5s.1"; });
  ASSERT_NE(job, plan.jobs.end());
  EXPECT_THAT(commandOf(experiment, *job), testing::IsSupersetOf({"--skip", "2.5"}));
  EXPECT_EQ(plan.skipped.back().name, "query.odometry.few.kidnapped-at-2s-for-1.5s");
  EXPECT_THAT(plan.skipped, testing::Contains(testing::Field(&SkippedCombination::reason,
                                                             "the ground truth ends before the robot starts")));
}

TEST_F(ExperimentPlanTest, ADisturbedLogIsReplayedDisturbed) {
  const std::string disturbance =
      "disturbance: {drop_images: 0.3, dim: {at: 20, for: 10, light: 0}, odometry_scale: 1.1}, ";
  const Experiment experiment = read(with("maps:", disturbance + "maps:")), good = read(good_);
  const Job job = planExperiment(experiment).jobs.front();
  const std::vector<std::string> command = commandOf(experiment, job);
  const std::vector<std::string> options{"--drop-images", "0.3", "--dim", "20", "10", "0", "--odometry-scale", "1.1"};
  EXPECT_NE(std::search(command.begin(), command.end(), options.begin(), options.end()), command.end());
  EXPECT_TRUE(optionsOf(good.sessions.front().disturbance).empty());
  EXPECT_NE(JobDescriber(experiment).hashOf(job), JobDescriber(good).hashOf(job));
  EXPECT_NE(JobDescriber(experiment).matchHashOf(job), JobDescriber(good).matchHashOf(job));
}

TEST_F(ExperimentPlanTest, ConfigurationsShareADirectoryOfMatches) {
  const Experiment experiment = read(good_);
  const std::vector<Job> jobs = planExperiment(experiment).jobs;
  const Job &laser = jobs.front(), &few = jobs.back();
  ASSERT_NE(laser.method.configuration, few.method.configuration);
  EXPECT_NE(JobDescriber(experiment).hashOf(laser), JobDescriber(experiment).hashOf(few));
  EXPECT_EQ(JobDescriber(experiment).matchHashOf(laser), JobDescriber(experiment).matchHashOf(few));
}

TEST_F(ExperimentPlanTest, SkipsAKidnappingBeyondTheGroundTruth) {
  const ExperimentPlan plan = planExperiment(read(with("skip: 1.5", "skip: 8")));
  EXPECT_EQ(plan.jobs.size(), 18U);
  EXPECT_EQ(plan.skipped[2].reason, "the ground truth ends before the kidnapped robot sees again");
}

TEST_F(ExperimentPlanTest, RefusesABadConfiguration) {
  try {
    planExperiment(read(with("particles_count: 100", "particles_cuont: 100")));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("laser.ini: change 'LocalizationExperiment.particles_cuont=100'"));
  }
}

TEST_F(ExperimentPlanTest, TheCommandSaysAll) {
  const Experiment experiment = read(good_);
  const ExperimentPlan plan = planExperiment(experiment);
  const auto path_of = [&](const char* name) { return path(name).string(); };
  EXPECT_EQ(commandOf(experiment, plan.jobs.back()),
            (std::vector<std::string>{"localize",
                                      path_of("laser.ini"),
                                      "--rawlog",
                                      path_of("query.rawlog"),
                                      "--groundtruth",
                                      path_of("query.tum"),
                                      "--sensors",
                                      "laser",
                                      "--map",
                                      path_of("rooms.simplemap"),
                                      "--set",
                                      "LocalizationExperiment.particles_count=100",
                                      "--start",
                                      "given",
                                      "--kidnap",
                                      "2",
                                      "1.5",
                                      "--seed",
                                      "3",
                                      "--tables-only"}));
}

TEST_F(ExperimentPlanTest, TheHashTellsOfWhatDecidesOnTheResult) {
  const auto hashOfLast = [&](const std::string& text) {
    const Experiment experiment = read(text);
    return JobDescriber(experiment).hashOf(planExperiment(experiment).jobs.back());
  };
  const std::string hash = hashOfLast(good_);
  EXPECT_EQ(hashOfLast(good_), hash);
  EXPECT_EQ(hashOfLast(with("[laser, odometry]", "[laser]")), hash);  // other runs do not matter
  EXPECT_NE(hashOfLast(with("particles_count: 100", "particles_count: 101")), hash);
  for (const char* file : {"query.rawlog", "rooms.simplemap", "query.tum"}) {
    SetUp();
    std::ofstream(path(file), std::ios::app) << '\n';
    EXPECT_NE(hashOfLast(good_), hash) << file;
  }
}

TEST_F(ExperimentPlanTest, AKidnappingOfAnotherStartIsAnotherRun) {
  const Experiment experiment = read(good_), later = read(with("skip: 1.5", "skip: 1.5, start: 0.5"));
  const Job job = planExperiment(experiment).jobs.back(), later_job = planExperiment(later).jobs.back();
  EXPECT_EQ(later_job.id, "query.laser.few.kidnapped-at-2s-for-1.5s-after-0.5s.3");
  EXPECT_NE(later_job.id, job.id);
  EXPECT_NE(JobDescriber(later).hashOf(later_job), JobDescriber(experiment).hashOf(job));
}

TEST_F(ExperimentPlanTest, DescribesAJobInALine) {
  const Experiment experiment = read(good_);
  const std::string line = JobDescriber(experiment).describe(planExperiment(experiment).jobs.front());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_THAT(line, testing::StartsWith(R"({"id":"query.laser.laser.given.1","rawlog":"query","sensors":"laser",)"
                                        R"("configuration":"laser","start":"given","seed":1,"hash":")"));
}

}  // namespace
}  // namespace vmcl
