// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "canvas.h"

namespace vmcl {

/// What hangs on a wall or is set into it: painting, poster, window, door. No two look alike.
bool isDecoration(const std::string& kind);

/// All kinds, for messages.
std::string decorationNames();

/// Covers the canvas. Throws std::out_of_range for another kind.
void paintDecoration(const std::string& kind, const Canvas& canvas);

}  // namespace vmcl
