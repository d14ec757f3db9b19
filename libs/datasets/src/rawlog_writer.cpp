// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/rawlog_writer.h"

#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/archiveFrom_std_streams.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

namespace vmcl {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": cannot be written: " + reason);
}

std::string numbered(const std::string& label, int number, const std::string& extension) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "_%06d", number);
  return label + digits + extension;
}

}  // namespace

std::filesystem::path rawlogCompanion(const std::filesystem::path& log, const std::string& suffix) {
  std::filesystem::path stem = log;
  if (stem.extension() == ".gz") stem.replace_extension();
  stem.replace_extension();
  return stem += suffix;
}

RawlogWriter::RawlogWriter(const std::filesystem::path& log)
    : log_(log),
      file_(log),
      images_(rawlogCompanion(log, "_Images")),
      temporary_images_(images_.string() + ".part" + std::to_string(getpid())) {
  std::error_code error;
  if (std::filesystem::exists(images_, error) && !std::filesystem::exists(log, error) &&
      !(std::filesystem::is_directory(images_, error) && std::filesystem::is_empty(images_, error)))
    fail(images_, "it is there already and belongs to no log");
  std::filesystem::remove_all(temporary_images_, error);
  if (!std::filesystem::create_directory(temporary_images_, error)) fail(images_, error.message());
}

RawlogWriter::~RawlogWriter() {
  std::error_code ignored;
  std::filesystem::remove_all(temporary_images_, ignored);
}

void RawlogWriter::write(const mrpt::obs::CObservation& observation) {
  mrpt::serialization::CArchiveStreamBase<std::ostream> archive(file_.stream());
  try {
    archive << observation;
  } catch (const std::exception&) {
    fail(log_, "no room left?");
  }
}

std::string RawlogWriter::keepImage(const std::string& label, std::string_view encoded, const std::string& extension) {
  const std::string name = numbered(label, image_count_++, extension);
  std::ofstream image(temporary_images_ / name, std::ios::binary);
  image.write(encoded.data(), static_cast<std::streamsize>(encoded.size()));
  image.close();
  if (!image) fail(images_ / name, "no room left?");
  return name;
}

void RawlogWriter::write(mrpt::obs::CObservationImage observation, std::string_view encoded,
                         const std::string& extension) {
  observation.image.setExternalStorage(keepImage(observation.sensorLabel, encoded, extension));
  write(observation);
}

void RawlogWriter::write(mrpt::obs::CObservation3DRangeScan observation, std::string_view encoded,
                         const std::string& extension) {
  const std::string name = keepImage(observation.sensorLabel, encoded, extension);
  observation.intensityImage.setExternalStorage(name);
  const std::string depth_name = std::filesystem::path(name).stem().string() + "_depth.bin";
  try {
    observation.rangeImage_convertToExternalStorage(depth_name, temporary_images_.string());
  } catch (const std::exception&) {
    fail(images_ / depth_name, "no room left?");
  }
  write(observation);
}

void RawlogWriter::write(mrpt::obs::CObservationStereoImages observation, std::string_view left, std::string_view right,
                         const std::string& extension) {
  observation.imageLeft.setExternalStorage(keepImage(observation.sensorLabel + "_left", left, extension));
  observation.imageRight.setExternalStorage(keepImage(observation.sensorLabel + "_right", right, extension));
  write(observation);
}

void RawlogWriter::commit() {
  const std::filesystem::path older_images = temporary_images_.string() + ".old";
  std::error_code error, ignored;
  const bool replaces = std::filesystem::exists(std::filesystem::symlink_status(images_));
  const auto restore = [&] {
    if (replaces) std::filesystem::rename(older_images, images_, ignored);
  };
  if (replaces) std::filesystem::rename(images_, older_images, error);
  if (!error) std::filesystem::rename(temporary_images_, images_, error);
  if (error) {
    restore();
    fail(images_, error.message());
  }
  try {
    file_.commit();
  } catch (const std::exception&) {
    std::filesystem::rename(images_, temporary_images_, ignored);
    restore();
    throw;
  }
  std::filesystem::remove_all(older_images, ignored);
}

}  // namespace vmcl
