// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include "vmcl/mrpt/image_measurements.h"
#include "vmcl/mrpt/visual_keyframe_map.h"

namespace vmcl {
namespace {

using mrpt::math::TPoint3D;
using mrpt::opengl::CPointCloud;
using mrpt::opengl::CSetOfLines;

TPoint3D pointOf(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

CPointCloud::Ptr emptyCloud(const char* name, const mrpt::img::TColorf& color, float size_px) {
  auto cloud = CPointCloud::Create();
  cloud->setName(name);
  cloud->setColor(color);
  cloud->setPointSize(size_px);
  return cloud;
}

void insert(CPointCloud& cloud, const Eigen::Vector3d& point_in_map) {
  const Eigen::Vector3f point = point_in_map.cast<float>();
  cloud.insertPoint(point.x(), point.y(), point.z());
}

CPointCloud::Ptr landmarkCloud(const KeyframeMap& map) {
  auto cloud = emptyCloud("landmarks", {0.3F, 0.3F, 0.3F}, 2);
  for (const Landmark& landmark : map.landmarks) insert(*cloud, landmark.point_in_map);
  return cloud;
}

CPointCloud::Ptr matchedPoints(const PoseProblem& problem) {
  auto cloud = emptyCloud("matches", {0.1F, 0.7F, 0.2F}, 5);
  for (const Match& match : problem.matches)
    if (match.point) insert(*cloud, match.point->point_in_map);
  return cloud;
}

/// The four edges of the view of each keyframe and the frame about it.
CSetOfLines::Ptr keyframeFrusta(const KeyframeMap& map) {
  constexpr double depth = 0.1;  // m
  auto lines = CSetOfLines::Create();
  lines->setName("keyframes");
  lines->setColor(mrpt::img::TColorf(0.8F, 0.4F, 0.1F));
  for (const Keyframe& keyframe : map.keyframes) {
    const ReferenceCamera view = map.referenceCamera(keyframe);
    const double right = view.camera.width - 1.0, bottom = view.camera.height - 1.0;
    std::array<TPoint3D, 4> corners;
    const std::array<Eigen::Vector2d, 4> pixels{{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}}};
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = pointOf(view.map_from_camera * (depth * view.camera.ray(pixels[i])));
    for (std::size_t i = 0; i < 4; ++i) {
      lines->appendLine({pointOf(view.map_from_camera.translation()), corners[i]});
      lines->appendLine({corners[i], corners[(i + 1) % 4]});
    }
  }
  return lines;
}

}  // namespace

void VisualKeyframeMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const {
  if (!genericMapParams.enableSaveAs3DObject) return;
  const auto map = contentOrReport();
  if (!map) return;
  objects.insert(landmarkCloud(*map));
  objects.insert(keyframeFrusta(*map));
  if (const auto measurement = latestMeasurement()) objects.insert(matchedPoints(measurement->problem));
}

}  // namespace vmcl
