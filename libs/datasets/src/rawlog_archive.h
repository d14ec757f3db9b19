// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace vmcl {

/// Objects in a plain or gzip file. MRPT's own file archives take a short read for a whole one and an end inside an
/// object for the end of the log; this one reports both, and refuses what a hostile file could abuse: endless nesting
/// and absurd numbers of items in a collection.
class RawlogArchive final : public mrpt::serialization::CArchive {
 public:
  /// Throws std::runtime_error naming the file when it cannot be opened.
  explicit RawlogArchive(const std::filesystem::path& file);

  /// Whether the file ends here, as it may between two objects. Throws std::runtime_error when the compressed data
  /// are cut off or damaged.
  bool atEnd();

  /// Reads up to the object's body. Throws std::runtime_error saying what is wrong.
  void readHeader();

  /// The object whose header was read; null if a null was stored. Throws std::runtime_error saying what is wrong.
  mrpt::serialization::CSerializable::Ptr readBody();

  const std::string& className() const { return class_name_; }

  /// Share of the file read, [0, 1].
  double progress() const;

 protected:
  size_t read(void* buffer, size_t size) override;
  size_t write(const void* buffer, size_t size) override;

 private:
  void checkItemCount();
  [[noreturn]] void fail(const std::exception& error) const;

  struct Close {
    void operator()(gzFile file) const { gzclose_r(file); }
  };
  std::unique_ptr<gzFile_s, Close> file_;
  double file_bytes_ = 0;
  std::array<uint8_t, 16> ahead_{};  ///< bytes looked at before they are asked for: [ahead_begin_, ahead_end_)
  size_t ahead_begin_ = 0;
  size_t ahead_end_ = 0;
  std::string failure_;  ///< why a read failed; MRPT may replace what read() throws
  uintptr_t stack_base_ = 0;

  std::string class_name_;
  bool old_format_ = false;
  int8_t version_ = 0;
};

}  // namespace vmcl
