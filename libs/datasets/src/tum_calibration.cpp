// SPDX-License-Identifier: BSD-3-Clause
#include "tum_calibration.h"

#include <stdexcept>

#include "sensor_mount.h"
#include "vmcl/geometry/camera.h"
#include "vmcl/geometry/yaml_map.h"

namespace vmcl {
namespace {

mrpt::img::TCamera readTumCamera(YamlMap yaml) {
  const PinholeCamera pinhole{yaml.get<int>("width"), yaml.get<int>("height"), yaml.get<double>("fx"),
                              yaml.get<double>("fy"), yaml.get<double>("cx"),  yaml.get<double>("cy")};
  const auto k = yaml.numbers("distortion", 5);
  yaml.finish();
  pinhole.check();
  mrpt::img::TCamera camera;
  camera.ncols = static_cast<uint32_t>(pinhole.width);
  camera.nrows = static_cast<uint32_t>(pinhole.height);
  camera.setIntrinsicParamsFromValues(pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy);
  camera.setDistortionPlumbBob(k[0], k[1], k[2], k[3], k[4]);
  return camera;
}

}  // namespace

TumCalibration readTumCalibration(const std::filesystem::path& file) {
  YamlMap yaml = YamlMap::read(file);
  TumCalibration calibration;
  try {
    calibration.camera = readTumCamera(yaml.map("camera"));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  calibration.robot_from_camera = readMount(yaml.map("robot_from_camera")) + opticalAxes();
  calibration.mask_rows_from_top = yaml.get("mask_rows_from_top", 0);
  if (calibration.mask_rows_from_top < 0) yaml.fail("mask_rows_from_top", "is negative");
  yaml.has("depth");  // depth images are not imported
  yaml.finish();
  return calibration;
}

}  // namespace vmcl
