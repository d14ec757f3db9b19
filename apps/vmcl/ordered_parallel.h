// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <future>

namespace vmcl {

/// Streams jobs through worker threads: next(job) supplies them until it returns false, work(job) runs on several at
/// once, write(result) gets the results in the order of the jobs, on the calling thread. Memory stays bounded.
template <class Job, class Result, class Next, class Work, class Write>
void orderedParallel(int threads, Next&& next, Work&& work, Write&& write) {
  std::deque<std::future<Result>> running;
  const auto writeFirst = [&] {
    Result result = running.front().get();
    running.pop_front();
    write(result);
  };
  for (Job job; next(job);) {
    if (threads <= 1) {
      write(work(job));
      continue;
    }
    running.push_back(std::async(std::launch::async, [&work, job] { return work(job); }));
    if (running.size() >= static_cast<std::size_t>(threads)) writeFirst();
  }
  while (!running.empty()) writeFirst();
}

}  // namespace vmcl
