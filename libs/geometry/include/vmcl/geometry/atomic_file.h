// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>

namespace vmcl {

/// An output file that appears whole or not at all: written beside its place under a temporary name, synced and
/// renamed by commit(), removed if commit() is never reached.
class AtomicFile {
 public:
  /// Throws std::runtime_error naming the file when it cannot be opened.
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }

  /// For writers that open a path themselves: the temporary name to write to.
  const std::filesystem::path& temporaryPath() const { return temporary_; }

  /// Throws std::runtime_error naming the file when it could not be written whole (a full disk, say).
  void commit();

 private:
  std::filesystem::path file_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace vmcl
