// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

namespace vmcl {

/// What went wrong, in one line: MRPT's exceptions carry a call stack and source lines, of which only the message at
/// their root is kept.
std::string errorMessage(const std::exception& error);

}  // namespace vmcl
