// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/object_file.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

#include "vmcl/mrpt/error_message.h"

namespace vmcl {

void readObject(const std::filesystem::path& file, mrpt::serialization::CSerializable& object) try {
  mrpt::io::CFileGZInputStream stream;
  if (!std::filesystem::is_regular_file(file) || !stream.open(file.string()))
    throw std::runtime_error("cannot be opened");
  mrpt::serialization::archiveFrom(stream) >> object;
} catch (const std::exception& error) {
  throw std::runtime_error(file.string() + ": " + errorMessage(error));
}

}  // namespace vmcl
