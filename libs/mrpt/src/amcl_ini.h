// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include "vmcl/mrpt/localization_config.h"

namespace vmcl {

/// Whether the ini has a section [amcl].
bool hasAmclSection(const mrpt::config::CConfigFileBase& ini);

/// Reads [amcl], AMCL's parameters under its names (those of Navigation 2, selective_resampling of ROS 1) with its
/// defaults, in place of [KLD_options], [PF_options], [DummyOdometryParams] and particles_count. Throws
/// std::invalid_argument naming section and key.
void readAmclSection(const mrpt::config::CConfigFileBase& ini, LocalizationConfig& config);

}  // namespace vmcl
