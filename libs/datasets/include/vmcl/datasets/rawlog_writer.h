// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {

/// A file or directory that belongs to a log: its path without .rawlog or .rawlog.gz, then `suffix`. MRPT's programs
/// look for outside images in "_Images"; the true poses of a log are kept in ".groundtruth.tum".
std::filesystem::path rawlogCompanion(const std::filesystem::path& log, const std::string& suffix);

/// Writes a rawlog of single observations, in the order given, its images outside. Log and images appear together at
/// commit() and replace an older log and its images; without commit() nothing changes.
class RawlogWriter {
 public:
  /// Throws std::runtime_error naming the file when log or image directory cannot be written, or when there is
  /// something in the image directory though there is no older log that it could belong to.
  explicit RawlogWriter(const std::filesystem::path& log);
  ~RawlogWriter();
  RawlogWriter(const RawlogWriter&) = delete;
  RawlogWriter& operator=(const RawlogWriter&) = delete;

  /// Throws std::runtime_error naming the file when it cannot be written.
  void write(const mrpt::obs::CObservation& observation);

  /// Keeps the image outside: `encoded` is a whole JPEG or PNG file, `extension` its ending with the dot.
  void write(mrpt::obs::CObservationImage observation, std::string_view encoded, const std::string& extension);

  /// Keeps intensity image and depth image outside.
  void write(mrpt::obs::CObservation3DRangeScan observation, std::string_view encoded, const std::string& extension);

  /// Keeps both images outside.
  void write(mrpt::obs::CObservationStereoImages observation, std::string_view left, std::string_view right,
             const std::string& extension);

  /// Throws std::runtime_error naming the file when it could not be written whole.
  void commit();

 private:
  std::string keepImage(const std::string& label, std::string_view encoded, const std::string& extension);

  std::filesystem::path log_;
  AtomicFile file_;
  std::filesystem::path images_;
  std::filesystem::path temporary_images_;
  int image_count_ = 0;
};

}  // namespace vmcl
