// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/job_runner.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <thread>

#include "child_process.h"
#include "run_files.h"
#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

namespace fs = std::filesystem;

/// Not to be met by any other program that fills the directory, on any machine.
std::string uniqueName(const Job& job) {
  char host[65] = {};
  gethostname(host, sizeof host - 1);
  return job.id + '.' + host + '.' + std::to_string(getpid());
}

void createDirectories(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw std::runtime_error(directory.string() + ": cannot be made: " + error.message());
}

/// Whether the path still names the open file: another holder of the lock may have removed it meanwhile.
bool isAt(const fs::path& path, int descriptor) {
  struct stat there {
  }, here{};
  return stat(path.c_str(), &there) == 0 && fstat(descriptor, &here) == 0 && there.st_ino == here.st_ino &&
         there.st_dev == here.st_dev;
}

}  // namespace

DirectoryLock::DirectoryLock(const fs::path& directory, Kind kind) : file_(directory / "lock"), kind_(kind) {
  createDirectories(directory);
  const int operation = (kind == Kind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB;
  do {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw std::runtime_error(file_.string() + ": cannot be opened: " + std::strerror(errno));
    if (flock(descriptor_, operation) == 0) continue;
    const int reason = errno;
    close(descriptor_);
    throw std::runtime_error(directory.string() + (reason == EWOULDBLOCK ? ": another vmcl evaluate is at work there"
                                                                         : ": cannot be locked"));
  } while (!isAt(file_, descriptor_));
}

DirectoryLock::~DirectoryLock() {
  if (kind_ == Kind::alone) unlink(file_.c_str());
  close(descriptor_);
}

void JobRunner::writeJobList(const std::vector<Job>& jobs) {
  AtomicFile list(directory_ / "jobs.jsonl");
  for (const Job& job : jobs) list.stream() << describe(job) << '\n';
  list.commit();
}

bool JobRunner::isDone(const Job& job) {
  const fs::path directory = runDirectory(directory_, job);
  if (!readRunEnd(directory).done) return false;
  const std::scoped_lock lock(describer_mutex_);
  if (readJobHash(directory) == describer_.hashOf(job)) return true;
  throw std::runtime_error(directory.string() +
                           ": is of another configuration, log or map of these names: use another directory");
}

bool JobRunner::hasResults() const { return fs::exists(directory_ / "runs") || fs::exists(directory_ / "unfinished"); }

void JobRunner::removeUnfinished() const {
  std::error_code ignored;
  fs::remove_all(directory_ / "unfinished", ignored);
}

std::string JobRunner::describe(const Job& job) {
  const std::scoped_lock lock(describer_mutex_);
  return describer_.describe(job);
}

std::string JobRunner::matchHashOf(const Job& job) {
  const std::scoped_lock lock(describer_mutex_);
  return describer_.matchHashOf(job);
}

std::string JobRunner::run(const Job& job) {
  const fs::path aside = directory_ / "unfinished" / uniqueName(job), place = runDirectory(directory_, job);
  createDirectories(aside);
  createDirectories(place.parent_path());
  std::vector<std::string> arguments = commandOf(experiment_, job);
  arguments.insert(arguments.end(), {"--out", aside.string()});
  if (experiment_.keep_matches)
    arguments.insert(arguments.end(), {"--set", "MetricMap_visualKeyframes_00_creationOpts.match_directory=" +
                                                    (directory_ / "matches" / matchHashOf(job)).string()});
  const ProcessEnd end = runProcess(vmcl_, arguments, aside / "stdout.txt", aside / "stderr.txt");
  writeRunEnd(aside, end, describe(job));
  const std::string reason = readRunEnd(aside).reason;
  std::error_code error;
  if (!readRunEnd(place).done) fs::remove_all(place, error);
  fs::rename(aside, place, error);
  if (error && !readRunEnd(place).done)
    throw std::runtime_error(place.string() + ": cannot be written: " + error.message());
  if (error) fs::remove_all(aside, error);  // another machine was faster
  return reason;
}

void JobRunner::run(const std::vector<Job>& jobs, int workers, const std::function<void(std::size_t)>& on_end) {
  std::mutex mutex;
  std::size_t begun = 0, ended = 0;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::unique_lock lock(mutex); begun < jobs.size() && !failure;) {
      const Job& job = jobs[begun++];
      lock.unlock();
      std::exception_ptr thrown;
      try {
        run(job);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (thrown && !failure) failure = thrown;
      on_end(++ended);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < workers; ++i) threads.emplace_back(work);
  }
  removeUnfinished();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace vmcl
