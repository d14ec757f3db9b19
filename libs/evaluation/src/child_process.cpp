// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace vmcl {
namespace {

constexpr int cannot_start = 127;

/// A file descriptor that is closed with the object and in the child's program.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags) : number_(open(file.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) throw std::runtime_error(file.string() + ": cannot be opened: " + std::strerror(errno));
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// The child's part, between fork and exec: only what is safe after a fork of a program with threads.
[[noreturn]] void become(const char* program, char* const* arguments, pid_t parent, int in, int out, int errors) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(cannot_start);  // killed before it could take effect
  if (dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 && dup2(errors, STDERR_FILENO) >= 0)
    execv(program, arguments);
  _exit(cannot_start);
}

}  // namespace

ProcessEnd runProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& out, const std::filesystem::path& errors) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const Descriptor nothing("/dev/null", O_RDONLY), out_file(out, O_WRONLY | O_CREAT | O_TRUNC),
      errors_file(errors, O_WRONLY | O_CREAT | O_TRUNC);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error(program.string() + ": cannot be started: " + std::strerror(errno));
  if (child == 0)
    become(pointers.front(), pointers.data(), parent, nothing.number(), out_file.number(), errors_file.number());
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) throw std::runtime_error(program.string() + ": cannot be waited for: " + std::strerror(errno));
  if (WIFEXITED(status) && WEXITSTATUS(status) == cannot_start)
    throw std::runtime_error(program.string() + ": cannot be started");
  constexpr int64_t kibibyte = 1024;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          seconds(usage.ru_utime) + seconds(usage.ru_stime), kibibyte * usage.ru_maxrss};
}

}  // namespace vmcl
