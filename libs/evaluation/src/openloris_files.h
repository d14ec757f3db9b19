// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run_result.h"

namespace vmcl {

/// openloris/METHOD.START.SEED/SCENE.txt for the runs on sessions of OpenLORIS-Scene, as its evaluate.py reads them:
/// the poses while localized, of the frame base_link. Throws std::runtime_error naming the file.
void writeOpenLorisFiles(const std::filesystem::path& directory, const ExperimentResults& results);

}  // namespace vmcl
