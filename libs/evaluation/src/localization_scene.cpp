// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/opengl/CEllipsoid2D.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <cmath>
#include <stdexcept>

#include "vmcl/evaluation/localization_picture.h"
#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

using mrpt::img::TColorf;
using mrpt::opengl::CSetOfLines;

class Polyline {
 public:
  Polyline(const char* name, const TColorf& color) : lines_(CSetOfLines::Create()) {
    lines_->setName(name);
    lines_->setColor(color);
    lines_->setLineWidth(3);
  }

  void add(const PlanarPose& pose) {
    constexpr double height = 0.05;  // above the map, so that it stays visible
    if (is_drawing_) lines_->appendLine(last_.x, last_.y, height, pose.x, pose.y, height);
    last_ = pose;
    is_drawing_ = true;
  }

  void lift() { is_drawing_ = false; }
  const CSetOfLines::Ptr& lines() const { return lines_; }

 private:
  CSetOfLines::Ptr lines_;
  PlanarPose last_;
  bool is_drawing_ = false;
};

CSetOfLines::Ptr pathLines(const LocalizationRun& run) {
  Polyline path("path", TColorf(0.1F, 0.3F, 0.9F));
  for (const LocalizationFrame& frame : run.frames)
    frame.localized ? path.add(frame.cluster.robot_in_map) : path.lift();
  return path.lines();
}

CSetOfLines::Ptr truthLines(const Trajectory& ground_truth) {
  Polyline path("ground truth", TColorf(0.1F, 0.6F, 0.1F));
  for (const StampedPose& pose : ground_truth.poses()) path.add(planarPart(pose.map_from_robot));
  return path.lines();
}

/// Where the robot may be: an ellipse of three deviations and the heading, the likelier the more opaque.
mrpt::opengl::CSetOfObjects::Ptr hypotheses(const std::vector<PoseCluster>& clusters) {
  constexpr double height = 0.04, arrow = 0.4;  // m
  auto all = mrpt::opengl::CSetOfObjects::Create();
  all->setName("hypotheses");
  for (const PoseCluster& cluster : clusters) {
    const PlanarPose& pose = cluster.robot_in_map;
    const TColorf color(0.8F, 0.1F, 0.8F, static_cast<float>(0.3 + 0.7 * cluster.share));
    auto ellipse = mrpt::opengl::CEllipsoid2D::Create();
    ellipse->setCovMatrix(mrpt::math::CMatrixDouble22(cluster.covariance.topLeftCorner<2, 2>()));
    ellipse->setLocation(pose.x, pose.y, height);
    ellipse->setColor(color);
    all->insert(ellipse);
    auto heading = CSetOfLines::Create();
    heading->setColor(color);
    heading->setLineWidth(2);
    heading->appendLine(pose.x, pose.y, height, pose.x + arrow * std::cos(pose.phi),
                        pose.y + arrow * std::sin(pose.phi), height);
    all->insert(heading);
  }
  return all;
}

}  // namespace

void writeScene(const std::filesystem::path& file, const LocalizationRun& run, const Localizer& localizer) {
  mrpt::opengl::COpenGLScene scene;
  scene.insert(localizer.maps().getVisualization());
  auto particles = mrpt::opengl::CPointCloud::Create();
  particles->setName("particles");
  particles->setColor(TColorf(0.9F, 0.1F, 0.1F));
  particles->setPointSize(3);
  for (const auto& particle : localizer.particles().m_particles)
    particles->insertPoint(static_cast<float>(particle.d.x), static_cast<float>(particle.d.y), 0.02F);
  scene.insert(particles);
  scene.insert(hypotheses(localizer.clusters()));
  if (run.ground_truth) scene.insert(truthLines(*run.ground_truth));
  scene.insert(pathLines(run));
  AtomicFile out(file);
  if (!scene.saveToFile(out.temporaryPath().string())) throw std::runtime_error(file.string() + ": cannot be written");
  out.commit();
}

}  // namespace vmcl
