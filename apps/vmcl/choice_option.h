// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace vmcl {

/// Adds an option that takes the name of one of some values; help and complaints list the names. `chosen` outlives the
/// verb.
template <class Chosen, class Value>
CLI::Option* addChoice(CLI::App& verb, const std::string& option, Chosen& chosen,
                       const std::map<std::string, Value>& values, const std::string& description) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  const auto choose = [&chosen, values](const std::string& name) { chosen = values.at(name); };
  return verb.add_option_function<std::string>(option, choose, description)->check(CLI::IsMember(names));
}

}  // namespace vmcl
