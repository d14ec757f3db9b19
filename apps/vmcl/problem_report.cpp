// SPDX-License-Identifier: BSD-3-Clause
#include "problem_report.h"

#include <algorithm>
#include <iostream>

namespace vmcl {
namespace {

std::string withCount(const std::pair<std::string, int>& problem) {
  const auto& [text, count] = problem;
  return count == 1 ? text : text + " (" + std::to_string(count) + " times)";
}

}  // namespace

void ProblemReport::add(const std::string& problem) {
  const auto known =
      std::find_if(problems_.begin(), problems_.end(), [&](const auto& p) { return p.first == problem; });
  if (known == problems_.end())
    problems_.emplace_back(problem, 1);
  else
    ++known->second;
}

std::string ProblemReport::inOneLine() const {
  if (problems_.empty()) return "";
  const std::string others = " (and " + std::to_string(problems_.size() - 1) + " other problems)";
  return withCount(problems_.front()) + (problems_.size() == 1 ? "" : others);
}

void ProblemReport::print(const std::string& verb) const {
  for (const auto& problem : problems_) std::cerr << "vmcl " << verb << ": " << withCount(problem) << '\n';
}

}  // namespace vmcl
