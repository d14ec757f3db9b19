// SPDX-License-Identifier: BSD-3-Clause
#include "drawing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "surface_painter.h"

namespace vmcl {
namespace {

constexpr int max_texture_px = 16384;         // side of a texture that Mesa draws
constexpr double light_cell = 0.2;            // m that light is taken to change over
constexpr double max_pixels_per_metre = 350;  // of the images of models; finer ones would flicker
constexpr double no_cuts = 1e9;               // m: a face is one cell

/// Faces of surfaces that glow, or of those that do not.
std::vector<Face> facesThat(bool glow, const Scene& scene, const std::vector<Face>& faces) {
  std::vector<Face> chosen;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(chosen),
               [&](const Face& face) { return scene.surfaces[face.surface].glows == glow; });
  return chosen;
}

Drawing drawFacesOf(const std::vector<Surface>& surfaces, const std::vector<Face>& faces, uint64_t seed,
                    const Light* even_light, double cell) {
  std::vector<bool> wanted(surfaces.size());
  for (const Face& face : faces) wanted[face.surface] = true;
  const TextureAtlas atlas = paintAtlas(surfaces, wanted, seed, even_light);
  return {drawFaces(faces, surfaces, atlas, cell), atlas.image, false};
}

/// The view from the windows at this time of the day: its painter takes the daylight for its colour.
Drawing drawBackdrop(const Scene& scene, const Light& light, uint64_t seed) {
  std::vector<Surface> surfaces = scene.surfaces;
  const int day = static_cast<int>(255 * std::clamp(light.daylight, 0.0, 1.0));
  for (const Face& face : scene.backdrop) surfaces[face.surface].material.rgb = {day, day, day};
  return drawFacesOf(surfaces, scene.backdrop, seed, nullptr, no_cuts);
}

/// The image as fine as it can be told apart from nearby, given how large it is shown.
cv::Mat shrunk(const cv::Mat& image, const DrawnMesh& mesh) {
  double shown = 0, used = 0;
  for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
    const auto &a = mesh[i], &b = mesh[i + 1], &c = mesh[i + 2];
    shown += (b.point - a.point).cross(c.point - a.point).norm();
    const Eigen::Vector2f u = b.uv - a.uv, v = c.uv - a.uv;
    used += std::abs(u.x() * v.y() - u.y() * v.x());
  }
  const double scale = max_pixels_per_metre / std::sqrt(used * image.total() / std::max(shown, 1e-9));
  if (!(scale < 0.8)) return image;
  cv::Mat small;
  const auto side = [&](int length) { return std::max(4, static_cast<int>(std::lround(length * scale))); };
  cv::resize(image, small, {side(image.cols), side(image.rows)}, 0, 0, cv::INTER_AREA);
  return small;
}

std::vector<Drawing> drawModels(const Scene& scene) {
  std::map<std::string, Drawing> by_image;
  for (const Model& model : scene.models)
    for (const ModelPart& part : model.mesh->parts) {
      const auto [red, green, blue] = part.rgb;
      const bool has_image = !part.texture.empty();
      const std::string key = has_image ? part.texture.string() : std::to_string(red << 16 | green << 8 | blue);
      Drawing& drawing = by_image[key];
      if (drawing.image.empty())
        drawing.image = has_image ? cv::imread(key) : cv::Mat(4, 4, CV_8UC3, cv::Scalar(blue, green, red));
      if (drawing.image.empty()) throw std::runtime_error(key + ": is not an image");
      const DrawnMesh mesh = drawModelPart(model, part, light_cell);
      drawing.mesh.insert(drawing.mesh.end(), mesh.begin(), mesh.end());
    }
  std::vector<Drawing> drawings;
  for (auto& [key, drawing] : by_image) {
    drawing.image = shrunk(drawing.image, drawing.mesh);
    drawings.push_back(std::move(drawing));
  }
  return drawings;
}

}  // namespace

std::vector<Drawing> drawingsOf(const Scene& scene, const Light& light, uint64_t texture_seed,
                                const LightTracer* tracer) {
  std::vector<Drawing> drawings;
  const auto dull = facesThat(false, scene, scene.faces), glowing = facesThat(true, scene, scene.faces);
  if (!dull.empty())
    drawings.push_back(
        drawFacesOf(scene.surfaces, dull, texture_seed, tracer ? nullptr : &light, tracer ? light_cell : no_cuts));
  for (Drawing& model : drawModels(scene)) drawings.push_back(std::move(model));
  for (Drawing& drawing : drawings) {
    drawing.lit = tracer != nullptr;
    if (tracer) illuminate(drawing.mesh, *tracer);
  }
  if (!glowing.empty()) {
    drawings.push_back(drawFacesOf(scene.surfaces, glowing, texture_seed, nullptr, no_cuts));
    drawings.back().image *= 0.4 + 0.6 * std::min(1.0, light.lamps);
  }
  if (!scene.backdrop.empty()) drawings.push_back(drawBackdrop(scene, light, texture_seed));
  return drawings;
}

TextureAtlas paintAtlas(const std::vector<Surface>& surfaces, const std::vector<bool>& wanted, uint64_t texture_seed,
                        const Light* even_light) {
  std::vector<cv::Mat> images(surfaces.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!wanted[i]) continue;
    images[i] = paintSurface(surfaces[i], texture_seed, i);
    if (even_light) shadeEvenly(images[i], surfaces[i], *even_light);
  }
  return packAtlas(images, max_texture_px);
}

}  // namespace vmcl
