// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vmcl {

/// What is wrong with a verb's input: each thing is said once, with how often it was met.
class ProblemReport {
 public:
  void add(const std::string& problem);

  bool empty() const { return problems_.empty(); }

  /// For when nothing could be done: the first problem, and that there are others. "" when empty.
  std::string inOneLine() const;

  /// For when the rest could be used: a line each on stderr, in the order in which they were met.
  void print(const std::string& verb) const;

 private:
  std::vector<std::pair<std::string, int>> problems_;  ///< and how often
};

}  // namespace vmcl
