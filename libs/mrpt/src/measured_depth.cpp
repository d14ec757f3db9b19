// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/measured_depth.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "camera_calibration.h"
#include "grey_image.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/pose_conversion.h"
#include "vmcl/vision/stereo_depth.h"

namespace vmcl {
namespace {

using mrpt::obs::CObservation3DRangeScan;

void checkSize(std::size_t rows, std::size_t columns, const PinholeCamera& camera) {
  if (rows == static_cast<std::size_t>(camera.height) && columns == static_cast<std::size_t>(camera.width)) return;
  throw std::runtime_error("the range image is " + std::to_string(columns) + "x" + std::to_string(rows) +
                           ", its intrinsics are for " + std::to_string(camera.width) + "x" +
                           std::to_string(camera.height));
}

/// As CObservation3DRangeScan::load(), which knows one directory for the whole process.
mrpt::math::CMatrix_u16 readRanges(const std::filesystem::path& file, const PinholeCamera& camera) {
  mrpt::io::CFileGZInputStream stream;
  if (!stream.open(file.string())) throw std::runtime_error(file.string() + ": cannot be opened");
  auto archive = mrpt::serialization::archiveFrom(stream);
  const auto rows = archive.ReadAs<uint32_t>(), columns = archive.ReadAs<uint32_t>();
  checkSize(rows, columns, camera);
  mrpt::math::CMatrix_u16 ranges(rows, columns);
  const auto bytes = static_cast<std::size_t>(ranges.size()) * sizeof(uint16_t);
  if (archive.ReadBufferFixEndianness<uint16_t>(ranges.data(), static_cast<std::size_t>(ranges.size())) != bytes)
    throw std::runtime_error(file.string() + ": cut off");
  return ranges;
}

/// Along the optical axis of the camera that took the range image.
DepthImage depthOf(const CObservation3DRangeScan& scan, const CameraCalibration& camera,
                   const mrpt::math::CMatrix_u16& ranges) {
  const auto& [width, height] = std::pair(camera.pinhole.width, camera.pinhole.height);
  DepthImage depth{width, height, std::vector<float>(static_cast<std::size_t>(width) * height)};
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      float& value = depth.depths[static_cast<std::size_t>(v * width + u)];
      value = scan.rangeUnits * static_cast<float>(ranges(v, u));
      if (value > 0 && !scan.range_is_depth)
        value /= static_cast<float>(camera.pinhole.ray(camera.undistort(Eigen::Vector2d(u, v))).norm());
    }
  return depth;
}

/// As seen by another camera: each pixel becomes a patch there as large as it looks, and the nearest is seen.
DepthImage seenBy(const CameraCalibration& other, const Rigid3& other_from_camera, const DepthImage& depth,
                  const CameraCalibration& camera) {
  DepthImage seen{other.pinhole.width, other.pinhole.height, {}};
  seen.depths.resize(static_cast<std::size_t>(seen.width) * static_cast<std::size_t>(seen.height));
  const double half_patch = 0.5 * std::max(1.0, other.pinhole.fx / camera.pinhole.fx);
  for (int v = 0; v < depth.height; ++v)
    for (int u = 0; u < depth.width; ++u) {
      const float measured = depth.depths[static_cast<std::size_t>(v * depth.width + u)];
      if (!(measured > 0)) continue;
      const Eigen::Vector3d point =
          other_from_camera * (measured * camera.pinhole.ray(camera.undistort(Eigen::Vector2d(u, v))));
      if (!(point.z() > 0)) continue;
      const Eigen::Vector2d pixel = other.distort(other.pinhole.project(point));
      if (!other.pinhole.contains(pixel)) continue;
      const auto first = [&](double at) { return std::max(0, static_cast<int>(std::ceil(at - half_patch))); };
      const auto last = [&](double at, int size) { return std::min(size - 1, static_cast<int>(at + half_patch)); };
      for (int row = first(pixel.y()); row <= last(pixel.y(), seen.height); ++row)
        for (int column = first(pixel.x()); column <= last(pixel.x(), seen.width); ++column) {
          float& nearest = seen.depths[static_cast<std::size_t>(row * seen.width + column)];
          if (!(nearest > 0) || point.z() < nearest) nearest = static_cast<float>(point.z());
        }
    }
  return seen;
}

DepthImage convert(const CObservation3DRangeScan& scan, const std::filesystem::path& directory) {
  if (!(scan.rangeUnits > 0) || !std::isfinite(scan.rangeUnits))
    throw std::runtime_error("range units of " + std::to_string(scan.rangeUnits));
  const CameraCalibration camera = calibrationOf(scan.cameraParams), image = calibrationOf(scan.cameraParamsIntensity);
  const auto& ranges = scan.rangeImage;
  if (!scan.rangeImage_isExternallyStored())
    checkSize(static_cast<std::size_t>(ranges.rows()), static_cast<std::size_t>(ranges.cols()), camera.pinhole);
  const DepthImage depth =
      depthOf(scan, camera,
              scan.rangeImage_isExternallyStored()
                  ? readRanges(directory / scan.rangeImage_getExternalStorageFile(""), camera.pinhole)
                  : ranges);
  // The depth camera's frame has the robot's kind of axes, the intensity camera's the optical ones.
  constexpr double right_angle = std::numbers::pi / 2;
  const Rigid3 image_from_camera =
      toRigid3(mrpt::poses::CPose3D(0, 0, 0, -right_angle, 0, -right_angle) - scan.relativePoseIntensityWRTDepth);
  if (!image_from_camera.matrix().allFinite()) throw std::runtime_error("the range camera's pose is not finite");
  if (sameCalibration(camera, image) && image_from_camera.isApprox(Rigid3::Identity(), 1e-6)) return depth;
  return seenBy(image, image_from_camera, depth, camera);
}

DepthImage convert(const mrpt::obs::CObservationStereoImages& pair) {
  return stereoDepth({calibrationOf(pair.leftCamera), calibrationOf(pair.rightCamera),
                      toRigid3(mrpt::poses::CPose3D(pair.rightCameraPose))},
                     greyImage(pair.imageLeft), greyImage(pair.imageRight));
}

}  // namespace

DepthImage measuredDepth(const mrpt::obs::CObservation& observation, const std::filesystem::path& directory) try {
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation); scan && scan->hasRangeImage)
    return convert(*scan, directory);
  if (const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation);
      pair && pair->hasImageRight)
    return convert(*pair);
  return {};
} catch (const std::exception& error) {
  throw std::runtime_error("camera '" + observation.sensorLabel + "': " + errorMessage(error));
}

}  // namespace vmcl
