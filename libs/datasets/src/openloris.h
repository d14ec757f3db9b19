// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "vmcl/datasets/import_report.h"

namespace vmcl {

inline constexpr char openloris_robot_frame[] = "base_link";

// The two forms that a sequence of OpenLORIS-Scene comes in; see importOpenLoris.
ImportReport importOpenLorisFolder(const std::filesystem::path& directory, const std::filesystem::path& log,
                                   const std::function<void(double share)>& progress);
ImportReport importOpenLorisBag(const std::filesystem::path& bag, const std::filesystem::path& log,
                                const std::function<void(double share)>& progress);

}  // namespace vmcl
