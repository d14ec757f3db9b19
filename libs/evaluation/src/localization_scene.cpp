// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>

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
    if (last_) lines_->appendLine(last_->x, last_->y, height, pose.x, pose.y, height);
    last_ = pose;
  }

  void lift() { last_.reset(); }
  const CSetOfLines::Ptr& lines() const { return lines_; }

 private:
  CSetOfLines::Ptr lines_;
  std::optional<PlanarPose> last_;
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
  if (run.ground_truth) scene.insert(truthLines(*run.ground_truth));
  scene.insert(pathLines(run));
  AtomicFile out(file);
  if (!scene.saveToFile(out.temporaryPath().string())) throw std::runtime_error(file.string() + ": cannot be written");
  out.commit();
}

}  // namespace vmcl
