// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <cstdint>
#include <set>
#include <string>

namespace vmcl {

/// Reads one section of an ini strictly, where MRPT takes "abc" for 0 and skips what it does not know. Every error is a
/// std::invalid_argument that names section, key and value.
class IniSection {
 public:
  IniSection(const mrpt::config::CConfigFileBase& ini, std::string section);

  bool has(const std::string& key) const;

  /// Each leaves the variable alone when the key is absent. Numbers must be finite and the whole value.
  void read(const std::string& key, double& value);
  void read(const std::string& key, int& value);
  void read(const std::string& key, bool& value);
  void read(const std::string& key, std::string& value);

  /// Marks keys as known that others read.
  void allow(std::initializer_list<const char*> keys);

  /// Throws for a key of the section that was neither read nor allowed.
  void refuseUnknownKeys() const;

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;

 private:
  std::string text(const std::string& key);
  template <typename Number>
  void readNumber(const std::string& key, Number& value, const char* kind);

  const mrpt::config::CConfigFileBase& ini_;
  std::string section_;
  std::set<std::string> known_;  ///< lower case, as keys are compared without regard to case
};

}  // namespace vmcl
