// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <filesystem>

namespace vmcl {

/// Reads one object of MRPT, such as a CSimpleMap, from a file that may be gzipped. Throws std::runtime_error naming
/// the file: it cannot be opened, or holds something else.
void readObject(const std::filesystem::path& file, mrpt::serialization::CSerializable& object);

}  // namespace vmcl
