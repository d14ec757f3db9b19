// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/ini_section.h"

#include <mrpt/system/string_utils.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace vmcl {

using mrpt::system::lowerCase;

IniSection::IniSection(const mrpt::config::CConfigFileBase& ini, std::string section)
    : ini_(ini), section_(std::move(section)) {}

bool IniSection::has(const std::string& key) const { return ini_.keyExists(section_, key); }

void IniSection::fail(const std::string& key, const std::string& reason) const {
  throw std::invalid_argument("[" + section_ + "] " + key + ": " + reason);
}

std::string IniSection::text(const std::string& key) {
  known_.insert(lowerCase(key));
  return ini_.read_string(section_, key, "");
}

template <typename Number>
void IniSection::readNumber(const std::string& key, Number& value, const char* kind) {
  const std::string word = text(key);
  if (!has(key)) return;
  Number number{};
  const char* const end = word.data() + word.size();
  const char* const begin = word.data() + (word.size() > 1 && word.front() == '+' ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, end, number);
  bool valid = error == std::errc() && stop == end;
  if constexpr (std::is_floating_point_v<Number>) valid = valid && std::isfinite(number);
  if (!valid) fail(key, "'" + word + "' is not " + kind);
  value = number;
}

void IniSection::read(const std::string& key, double& value) { readNumber(key, value, "a finite number"); }
void IniSection::read(const std::string& key, int& value) { readNumber(key, value, "a whole number"); }

void IniSection::read(const std::string& key, bool& value) {
  const std::string word = lowerCase(text(key));
  if (!has(key)) return;
  const bool yes = word == "true" || word == "yes" || word == "1";
  if (!yes && word != "false" && word != "no" && word != "0") fail(key, "'" + word + "' is neither true nor false");
  value = yes;
}

void IniSection::read(const std::string& key, std::string& value) {
  const std::string word = text(key);
  if (has(key)) value = word;
}

void IniSection::allow(std::initializer_list<const char*> keys) {
  for (const char* key : keys) known_.insert(lowerCase(key));
}

void IniSection::refuseUnknownKeys() const {
  std::vector<std::string> keys;
  ini_.getAllKeys(section_, keys);
  for (const std::string& key : keys)
    if (!known_.contains(lowerCase(key))) fail(key, "unknown key");
}

}  // namespace vmcl
