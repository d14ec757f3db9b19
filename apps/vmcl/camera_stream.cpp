// SPDX-License-Identifier: BSD-3-Clause
#include "camera_stream.h"

#include "vmcl/mrpt/error_message.h"

namespace vmcl {

CameraStream::CameraStream(const std::filesystem::path& rawlog) : rawlog_(rawlog), reader_(rawlog) {}

std::optional<CameraObservation> CameraStream::next() {
  while (!waiting_.empty() || readEntry()) {
    if (waiting_.empty()) continue;
    const auto observation = waiting_.front();
    waiting_.pop_front();
    try {
      if (auto camera = cameraObservation(*observation)) return camera;
    } catch (const std::exception& error) {
      problems_.add(rawlog_.string() + ": " + errorMessage(error));
    }
  }
  return std::nullopt;
}

void CameraStream::reject(const std::string& label, double time, const std::string& reason) {
  problems_.add(rawlog_.string() + ": camera '" + label + "' at " + std::to_string(time) + " s: " + reason);
}

bool CameraStream::readEntry() {
  RawlogEntry entry;
  try {
    if (!reader_.next(entry)) return false;
  } catch (const std::runtime_error& error) {
    problems_.add(errorMessage(error));
    return false;
  }
  if (entry.frame) waiting_.assign(entry.frame->begin(), entry.frame->end());
  if (entry.observation) waiting_.push_back(entry.observation);
  return true;
}

}  // namespace vmcl
