// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "scene.h"
#include "surface_painter.h"
#include "vmcl/geometry/camera.h"

namespace vmcl {

/// Draws a scene off-screen, without a display (libmrpt's CFBORender on EGL; Mesa's software renderer will do).
class SceneRenderer {
 public:
  /// Throws std::runtime_error when off-screen drawing is not possible here, or the scene is too large for it.
  SceneRenderer(const Scene& scene, const Light& light, uint64_t texture_seed, const PinholeCamera& camera);
  ~SceneRenderer();

  /// BGR, drawn twice as fine and averaged.
  cv::Mat render(const Rigid3& map_from_camera);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vmcl
