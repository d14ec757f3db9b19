// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include "vmcl/vision/image.h"

namespace vmcl {

/// An image of an observation, which stays unloaded if it is kept outside. Throws std::runtime_error: none, a file that
/// cannot be read, pixels of more than 8 bit.
Image greyImage(const mrpt::img::CImage& image);

}  // namespace vmcl
