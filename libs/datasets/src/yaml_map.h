// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/geometry/yaml_map.h"
