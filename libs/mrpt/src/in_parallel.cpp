// SPDX-License-Identifier: BSD-3-Clause
#include "in_parallel.h"

#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace vmcl {

void inParallel(std::size_t threads, std::size_t count, const std::function<void(std::size_t, std::size_t)>& part) {
  std::vector<std::exception_ptr> failures(threads);
  const auto work = [&](std::size_t worker) {
    const std::size_t first = count * worker / threads;
    try {
      part(first, count * (worker + 1) / threads - first);
    } catch (...) {
      failures[worker] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    others.reserve(threads);
    std::size_t worker = 1;
    try {
      for (; worker < threads; ++worker) others.emplace_back(work, worker);
    } catch (const std::system_error&) {  // no more threads are to be had: this one does the rest
    }
    for (; worker < threads; ++worker) work(worker);
    work(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace vmcl
