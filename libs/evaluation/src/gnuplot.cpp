// SPDX-License-Identifier: BSD-3-Clause
#include "gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

/// All that is written to a pipe, until its last writer ends.
std::string readAll(int pipe) {
  std::string text;
  char buffer[512];
  for (ssize_t bytes; (bytes = read(pipe, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<size_t>(bytes));
  return text;
}

/// What gnuplot complained of, in one line; empty when it was content.
std::string complaintOfGnuplot(const std::filesystem::path& script) {
  std::string program = "gnuplot", argument = script.string();
  char* arguments[] = {program.data(), argument.data(), nullptr};
  int complaints[2];
  if (pipe2(complaints, O_CLOEXEC) != 0) return "no pipe to it";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, complaints[1], STDERR_FILENO);
  pid_t process = 0;
  const int error = posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(complaints[1]);
  std::string said = readAll(complaints[0]);
  close(complaints[0]);
  if (error != 0) return "cannot be started: is it installed?";
  int status = 0;
  if (waitpid(process, &status, 0) == process && status == 0) return {};
  std::ranges::replace(said, '\n', ' ');
  return "failed: " + said;
}

}  // namespace

std::string quoted(const std::filesystem::path& file) {
  std::string quoted = "'";
  for (const char c : file.string()) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

void runGnuplot(const std::filesystem::path& script, const std::filesystem::path& picture) {
  if (const std::string complaint = complaintOfGnuplot(script); !complaint.empty())
    throw std::runtime_error(picture.string() + ": cannot be drawn: gnuplot " + complaint);
}

void drawSvg(const std::filesystem::path& svg, const std::string& size, const std::string& commands) {
  AtomicFile script(std::filesystem::path(svg).replace_extension(".gnuplot")), picture(svg);
  script.stream() << "set terminal svg size " << size << " background rgb 'white' font 'Helvetica,14'\nset output "
                  << quoted(picture.temporaryPath()) << '\n'
                  << commands;
  script.stream().flush();
  runGnuplot(script.temporaryPath(), svg);
  picture.commit();
}

}  // namespace vmcl
