// SPDX-License-Identifier: BSD-3-Clause
//
// usage: spoil_rawlog IN.rawlog HOW OUT.rawlog
// Copies a log of single observations and spoils it on the way, HOW being a key of `spoilers`.
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>

#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <string>

namespace {

using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CRawlog;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <typename Observation>
std::function<void(CRawlog&)> each(void (*spoil)(Observation&)) {
  return [spoil](CRawlog& log) {
    for (std::size_t i = 0; i < log.size(); ++i)
      if (const auto observation = std::dynamic_pointer_cast<Observation>(log.getAsGeneric(i))) spoil(*observation);
  };
}

void removeCamera(CRawlog& log) {
  for (std::size_t i = log.size(); i-- > 0;)
    if (std::dynamic_pointer_cast<CObservationImage>(log.getAsGeneric(i))) log.remove(i);
}

mrpt::img::CImage blank(int width, int height, int grey) {
  mrpt::img::CImage image(width, height, mrpt::img::CH_GRAY);
  image.filledRectangle(0, 0, width - 1, height - 1, mrpt::img::TColor(grey, grey, grey));
  return image;
}

const std::map<std::string, std::function<void(CRawlog&)>> spoilers = {
    {"no_camera", removeCamera},
    {"no_intrinsics", each<CObservationImage>([](auto& o) { o.cameraParams = {}; })},
    {"nan_intrinsics", each<CObservationImage>([](auto& o) { o.cameraParams.fx(nan); })},
    {"nan_mount", each<CObservationImage>([](auto& o) { o.setSensorPose(mrpt::poses::CPose3D(nan, 0, 0)); })},
    {"missing_image", each<CObservationImage>([](auto& o) { o.image.setExternalStorage("missing.jpg"); })},
    {"small_images", each<CObservationImage>([](auto& o) { o.image = blank(320, 200, 0); })},
    {"white_images", each<CObservationImage>([](auto& o) { o.image = blank(640, 480, 255); })},
    {"same_times", each<CObservationImage>([](auto& o) { o.timestamp = mrpt::Clock::fromDouble(1000.5); })},
    {"nan_odometry", each<CObservationOdometry>([](auto& o) { o.odometry.x(nan); })},
};

}  // namespace

int main(int argc, char** argv) {
  CRawlog log;
  if (argc != 4 || !spoilers.contains(argv[2]) || !log.loadFromRawLogFile(argv[1])) {
    std::cerr << "usage: spoil_rawlog IN.rawlog HOW OUT.rawlog\n";
    return 2;
  }
  spoilers.at(argv[2])(log);
  return log.saveToRawLogFile(argv[3]) ? 0 : 1;
}
