// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/rawlog_reader.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <stdexcept>

#include "rawlog_archive.h"
#include "vmcl/datasets/rawlog_writer.h"

namespace vmcl {
namespace {

using mrpt::obs::CObservation;

void placeImage(mrpt::img::CImage& image, const std::filesystem::path& directory) {
  if (image.isExternallyStored()) image.setExternalStorage(directory / image.getExternalStorageFile());
}

/// MRPT looks for images outside the log in one directory for the whole process; whole paths need no such setting.
void placeImages(CObservation& observation, const std::filesystem::path& directory) {
  using namespace mrpt::obs;
  if (auto* camera = dynamic_cast<CObservationImage*>(&observation)) {
    placeImage(camera->image, directory);
  } else if (auto* depth_camera = dynamic_cast<CObservation3DRangeScan*>(&observation)) {
    placeImage(depth_camera->intensityImage, directory);
    placeImage(depth_camera->confidenceImage, directory);
  } else if (auto* stereo = dynamic_cast<CObservationStereoImages*>(&observation)) {
    placeImage(stereo->imageLeft, directory);
    placeImage(stereo->imageRight, directory);
    placeImage(stereo->imageDisparity, directory);
  }
}

}  // namespace

struct RawlogReader::State {
  explicit State(const std::filesystem::path& log)
      : file(log), images_directory(std::filesystem::absolute(rawlogCompanion(log, "_Images"))), archive(log) {}

  /// The next object; null at the end of the log.
  mrpt::serialization::CSerializable::Ptr nextObject() {
    try {
      if (!header_read && archive.atEnd()) return {};
      if (!header_read) archive.readHeader();
      header_read = false;
      auto object = archive.readBody();
      if (!object) throw std::runtime_error("is null");
      ++entry;
      return object;
    } catch (const std::runtime_error& error) {
      fail(error.what());
    }
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(file.string() + ": entry " + std::to_string(entry) + ": " + reason);
  }

  std::filesystem::path file;
  std::filesystem::path images_directory;
  RawlogArchive archive;
  std::size_t entry = 0;     ///< index of the object to be read next
  bool header_read = false;  ///< of that object
};

RawlogReader::RawlogReader(const std::filesystem::path& file) : state_(std::make_unique<State>(file)) {
  try {
    if (state_->archive.atEnd()) throw std::runtime_error("is empty");
    state_->archive.readHeader();
    state_->header_read = true;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": not a rawlog: " + error.what());
  }
}

RawlogReader::~RawlogReader() = default;

bool RawlogReader::next(RawlogEntry& entry) {
  entry = {};
  while (const auto object = state_->nextObject()) {
    if (auto action = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
      entry.action = action;
    } else if (auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
      for (const auto& observation : *frame) {
        if (!observation) state_->fail("a frame holds something that is no observation");
        placeImages(*observation, state_->images_directory);
      }
      if (!entry.action) continue;  // a log may start with a frame before the first motion
      entry.frame = frame;
      return true;
    } else if (auto observation = std::dynamic_pointer_cast<CObservation>(object); observation && !entry.action) {
      placeImages(*observation, state_->images_directory);
      entry.observation = observation;
      return true;
    }
  }
  entry = {};  // a log may end with a motion after the last frame
  return false;
}

double RawlogReader::progress() const { return state_->archive.progress(); }

}  // namespace vmcl
