// SPDX-License-Identifier: BSD-3-Clause
#include "rawlog_archive.h"

#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>

namespace vmcl {
namespace {

constexpr uint32_t max_items = 100'000;                      // observations in a frame, actions in a collection
constexpr uintptr_t max_stack_bytes = uintptr_t{256} << 10;  // an observation of a real log needs a few kilobytes

/// The innermost reason in MRPT's nested, many-lined texts.
std::string reason(std::string text) {
  constexpr std::string_view key = "Message:";
  if (const auto start = text.rfind(key); start != std::string::npos) text.erase(0, start + key.size());
  text.erase(0, text.find_first_not_of(" \n"));
  return text.substr(0, text.find('\n'));
}

uintptr_t stackPosition() { return reinterpret_cast<uintptr_t>(__builtin_frame_address(0)); }

}  // namespace

RawlogArchive::RawlogArchive(const std::filesystem::path& file) : file_(gzopen(file.c_str(), "rb")) {
  std::error_code error;
  if (!file_ || !std::filesystem::is_regular_file(file, error))
    throw std::runtime_error(file.string() + ": cannot be opened");
  gzbuffer(file_.get(), 1 << 17);
  file_bytes_ = static_cast<double>(std::filesystem::file_size(file));
}

bool RawlogArchive::atEnd() {
  if (ahead_begin_ < ahead_end_) return false;
  const int byte = gzgetc(file_.get());
  if (byte >= 0) {
    ahead_[0] = static_cast<uint8_t>(byte);
    ahead_begin_ = 0;
    ahead_end_ = 1;
    return false;
  }
  int error = Z_OK;
  gzerror(file_.get(), &error);
  if (error != Z_OK && error != Z_STREAM_END) throw std::runtime_error("the compressed data are cut off or damaged");
  return true;
}

void RawlogArchive::readHeader() {
  class_name_.clear();
  try {
    internal_ReadObjectHeader(class_name_, old_format_, version_);
  } catch (const std::exception& error) {
    fail(error);
  }
  const bool printable = std::all_of(class_name_.begin(), class_name_.end(), [](char c) { return c > ' ' && c < 127; });
  if (class_name_.empty() || !printable) throw std::runtime_error("no object starts here");
}

mrpt::serialization::CSerializable::Ptr RawlogArchive::readBody() {
  stack_base_ = stackPosition();
  mrpt::serialization::CSerializable::Ptr object;
  try {
    if (class_name_ != "nullptr") {
      const auto* type = mrpt::rtti::findRegisteredClass(class_name_);
      if (!type) throw std::runtime_error("class " + class_name_ + " is not known");
      object = std::dynamic_pointer_cast<mrpt::serialization::CSerializable>(type->createObject());
      if (!object) throw std::runtime_error("class " + class_name_ + " cannot be stored");
      checkItemCount();
    }
    internal_ReadObject(object.get(), class_name_, old_format_, version_);
  } catch (const std::exception& error) {
    fail(error);
  }
  return object;
}

/// MRPT makes room for as many items as a collection claims before it reads the first.
void RawlogArchive::checkItemCount() {
  size_t bytes_before = 0;
  if (class_name_ == "CSensoryFrame" || class_name_ == "mrpt::obs::CSensoryFrame")
    bytes_before = version_ == 0 ? 12 : version_ == 1 ? 4 : 0;
  else if (class_name_ != "CActionCollection" && class_name_ != "mrpt::obs::CActionCollection")
    return;
  std::array<uint8_t, 16> peeked;
  read(peeked.data(), bytes_before + sizeof(uint32_t));
  ahead_ = peeked;
  ahead_begin_ = 0;
  ahead_end_ = bytes_before + sizeof(uint32_t);
  uint32_t count;
  std::memcpy(&count, &peeked[bytes_before], sizeof count);
  if (count > max_items) throw std::runtime_error("claims to hold " + std::to_string(count) + " items");
}

double RawlogArchive::progress() const {
  return std::clamp(static_cast<double>(gzoffset(file_.get())) / std::max(file_bytes_, 1.0), 0.0, 1.0);
}

size_t RawlogArchive::read(void* buffer, size_t size) {
  if (stack_base_ != 0 && stack_base_ - stackPosition() > max_stack_bytes)
    throw std::runtime_error(failure_ = "objects are nested too deeply");
  auto* to = static_cast<uint8_t*>(buffer);
  const size_t from_ahead = std::min(size, ahead_end_ - ahead_begin_);
  std::copy_n(&ahead_[ahead_begin_], from_ahead, to);
  ahead_begin_ += from_ahead;
  if (size > from_ahead && gzfread(to + from_ahead, 1, size - from_ahead, file_.get()) != size - from_ahead)
    throw std::runtime_error(failure_ = "cut off or damaged");
  return size;
}

size_t RawlogArchive::write(const void*, size_t) { throw std::logic_error("RawlogArchive is read only"); }

void RawlogArchive::fail(const std::exception& error) const {
  const bool no_memory = dynamic_cast<const std::bad_alloc*>(&error);
  const std::string why = !failure_.empty() ? failure_ : no_memory ? "claims too much memory" : reason(error.what());
  throw std::runtime_error((class_name_.empty() ? "object" : class_name_) + ": " + why);
}

}  // namespace vmcl
