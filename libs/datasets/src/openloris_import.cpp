// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/openloris_import.h"

#include "openloris.h"

namespace vmcl {

ImportReport importOpenLoris(const std::filesystem::path& directory_or_bag, const std::filesystem::path& log,
                             const std::function<void(double share)>& progress) {
  return std::filesystem::is_directory(directory_or_bag) ? importOpenLorisFolder(directory_or_bag, log, progress)
                                                         : importOpenLorisBag(directory_or_bag, log, progress);
}

}  // namespace vmcl
