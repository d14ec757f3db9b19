// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "light.h"
#include "scene.h"
#include "vmcl/geometry/camera.h"

namespace vmcl {

/// What a camera sees.
struct View {
  cv::Mat bgr;    ///< drawn twice as fine and averaged
  cv::Mat depth;  ///< metres along the optical axis (float), 0 where there is nothing; only if asked for
};

/// Draws a scene off-screen, without a display (libmrpt's CFBORender on EGL; Mesa's software renderer will do). Where
/// lamps or windows are placed in the scene, light is traced once and carried by the vertices.
class SceneRenderer {
 public:
  /// `figure_surfaces`: what moving figures show. Throws std::runtime_error when off-screen drawing is not possible
  /// here, or the scene is too large for it.
  SceneRenderer(const Scene& scene, const Light& light, uint64_t texture_seed,
                const std::vector<Surface>& figure_surfaces = {});
  ~SceneRenderer();

  /// Puts figures into the scene, in place of those before.
  void setFigures(const std::vector<Face>& faces);

  View render(const PinholeCamera& camera, const Rigid3& map_from_camera, bool with_depth = false);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vmcl
