// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <string>

#include "vmcl/mrpt/sensors.h"

namespace vmcl {

/// "section.key=value". The ini must have the key, unless the section is one of ours, whose unknown keys are refused
/// when they are read: MRPT would ignore one that is misspelt. Throws std::invalid_argument naming the change.
void changeValue(mrpt::config::CConfigFileMemory& ini, const std::string& change);

/// Leaves [MetricMap] without maps of other sensors. Throws std::invalid_argument when it has none of these sensors.
void keepMapsOf(mrpt::config::CConfigFileMemory& ini, Sensors sensors);

}  // namespace vmcl
