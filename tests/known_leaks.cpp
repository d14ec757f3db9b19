// SPDX-License-Identifier: BSD-3-Clause

/// Called by the leak sanitizer: leaks of other libraries that are not to fail a test, one a line.
extern "C" const char* __lsan_default_suppressions() {
  // holds a map's options by a raw pointer, so that it loses them when they refuse the ini
  return "leak:mrpt::maps::TSetOfMetricMapInitializers::loadFromConfigFile\n";
}
