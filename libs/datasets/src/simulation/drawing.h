// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "drawn_mesh.h"
#include "light.h"

namespace vmcl {

/// Triangles that show one image.
struct Drawing {
  DrawnMesh mesh;
  cv::Mat image;     ///< BGR
  bool lit = false;  ///< whether the light of the vertices counts
};

/// Whether light is traced; otherwise the surfaces are shaded evenly.
inline bool hasTracedLight(const Scene& scene) { return !scene.lamps.empty() || !scene.models.empty(); }

/// All that stands still, ready to be drawn; `tracer` is null where light is not traced.
std::vector<Drawing> drawingsOf(const Scene& scene, const Light& light, uint64_t texture_seed,
                                const LightTracer* tracer);

/// The images of the wanted surfaces, in one.
TextureAtlas paintAtlas(const std::vector<Surface>& surfaces, const std::vector<bool>& wanted, uint64_t texture_seed,
                        const Light* even_light = nullptr);

}  // namespace vmcl
