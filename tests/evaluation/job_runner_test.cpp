// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/job_runner.h"

#include <gmock/gmock.h>

#include <set>

#include "experiment_files.h"
#include "run_files.h"

namespace vmcl {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Runs a shell script in place of vmcl. Its last argument is the directory for the results.
class JobRunnerTest : public ExperimentFiles {
 protected:
  void SetUp() override {
    ExperimentFiles::SetUp();
    experiment_ = readExperiment(write("run.yaml", with("[laser, odometry]", "[laser]")));
    jobs_ = planExperiment(experiment_).jobs;
    become("echo done > \"$out/frames.csv\"");
  }

  void become(const std::string& script) const {
    write("vmcl", "#!/bin/sh\nfor out; do :; done\n" + script + '\n');
    fs::permissions(path("vmcl"), fs::perms::owner_all);
  }

  void run(int workers = 2) {
    JobRunner runner(experiment_, path("out"), path("vmcl"));
    runner.run(jobs_, workers, [&](std::size_t ended) { ended_.insert(ended); });
  }

  RunEnd endOf(const Job& job) const { return readRunEnd(runDirectory(path("out"), job)); }

  Experiment experiment_;
  std::vector<Job> jobs_;
  std::set<std::size_t> ended_;
};

TEST_F(JobRunnerTest, MakesAllRuns) {
  run();
  EXPECT_EQ(ended_.size(), jobs_.size());
  for (const Job& job : jobs_) {
    EXPECT_TRUE(endOf(job).done) << job.id;
    EXPECT_TRUE(fs::exists(path("out") / "runs" / job.id / "frames.csv"));
  }
  EXPECT_FALSE(fs::exists(path("out") / "unfinished"));
}

TEST_F(JobRunnerTest, AFailedRunIsRecordedAndTheOthersGoOn) {
  become("case \"$out\" in *few*) echo 'vmcl: query.rawlog: is broken' >&2; exit 2;; esac");
  run();
  for (const Job& job : jobs_) {
    EXPECT_TRUE(endOf(job).there);
    EXPECT_EQ(endOf(job).done, job.id.find("few") == std::string::npos);
    EXPECT_EQ(endOf(job).reason, endOf(job).done ? "" : "query.rawlog: is broken");
  }
  JobRunner again(experiment_, path("out"), path("vmcl"));
  EXPECT_TRUE(again.isDone(jobs_.front()));
  EXPECT_FALSE(again.isDone(jobs_.back()));
  write("query.rawlog", "a better log");  // what was wrong is put right
  become("true");
  JobRunner better(experiment_, path("out"), path("vmcl"));
  EXPECT_FALSE(better.isDone(jobs_.back()));
  EXPECT_EQ(better.run(jobs_.back()), "");
  EXPECT_TRUE(better.isDone(jobs_.back()));
}

TEST_F(JobRunnerTest, TellsHowARunEnded) {
  become("kill -SEGV $$");
  run();
  EXPECT_THAT(endOf(jobs_[0]).reason, HasSubstr("Segmentation fault"));
  become("exit 3");
  run();
  EXPECT_EQ(endOf(jobs_[0]).reason, "exit code 3");
  become("echo 'vmcl localize: query.rawlog: ends early' >&2; echo a >\"$out/frames.csv\"; exit 1");
  run();
  EXPECT_TRUE(endOf(jobs_[0]).done);
  EXPECT_EQ(endOf(jobs_[0]).problems, std::vector<std::string>{"query.rawlog: ends early"});
}

TEST_F(JobRunnerTest, MeasuresWhatARunCosts) {
  become("sleep 0.5; head -c 300000000 /dev/zero | tail -c 200000000 > /dev/null");  // tail keeps 200 MB
  jobs_.resize(1);
  run();
  const RunCost cost = readRunCost(runDirectory(path("out"), jobs_[0]));
  EXPECT_GE(cost.seconds, 0.5);
  EXPECT_LT(cost.processor_seconds, cost.seconds);
  EXPECT_GT(cost.peak_memory, 200e6);
  EXPECT_LT(cost.peak_memory, 400e6);
}

TEST_F(JobRunnerTest, StopsWhenNothingCanBeKept) {
  write("out", "in the way");
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_LE(ended_.size(), 2U);
}

TEST_F(JobRunnerTest, NeedsAProgram) {
  fs::remove(path("vmcl"));
  try {
    run();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("vmcl: cannot be started"));
  }
}

TEST_F(JobRunnerTest, RefusesResultsOfAnotherMap) {
  run();
  write("rooms.simplemap", "another map");
  JobRunner other(experiment_, path("out"), path("vmcl"));
  try {
    other.isDone(jobs_[0]);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(jobs_[0].id + ": is of another configuration, log or map"));
  }
}

TEST_F(JobRunnerTest, OnlyOneFillsADirectoryAlone) {
  using Kind = DirectoryLock::Kind;
  {
    const DirectoryLock one(path("out"), Kind::shared), other(path("out"), Kind::shared);
    EXPECT_THROW(DirectoryLock(path("out"), Kind::alone), std::runtime_error);
  }
  {
    const DirectoryLock alone(path("out"), Kind::alone);
    EXPECT_THROW(DirectoryLock(path("out"), Kind::shared), std::runtime_error);
  }
  EXPECT_TRUE(fs::is_empty(path("out")));
}

}  // namespace
}  // namespace vmcl
