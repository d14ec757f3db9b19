// SPDX-License-Identifier: BSD-3-Clause
#include "scene_renderer.h"

#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfTexturedTriangles.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "drawing.h"

namespace vmcl {
namespace {

using mrpt::opengl::CFBORender;
using mrpt::opengl::CSetOfTexturedTriangles;

constexpr int fineness = 2;  // drawn pixels per image pixel and axis
constexpr float near_m = 0.05f, far_m = 150.0f;
constexpr float depth_edge = 0.1f;  // relative step of depth within a pixel that is taken for an edge

mrpt::math::TPoint3Df toPoint(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

/// A vertex as MRPT's shader wants it. All it lets a vertex say of light is its normal, and it shows the image as
/// brightly as the normal's cosine to the light from above times the light's colour; so the normal is turned to that.
mrpt::opengl::TTriangle::Vertex toShader(const DrawnVertex& drawn) {
  mrpt::opengl::TTriangle::Vertex vertex;
  vertex.xyzrgba.pt = toPoint(drawn.point);
  const float cosine = std::clamp(drawn.light / LightTracer::most, 0.0f, 1.0f);
  vertex.normal = {std::sqrt(1 - cosine * cosine), 0, cosine};
  vertex.uv = {drawn.uv.x(), drawn.uv.y()};
  return vertex;
}

void setTriangles(CSetOfTexturedTriangles& object, const DrawnMesh& mesh) {
  object.clearTriangles();
  for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
    mrpt::opengl::TTriangle triangle;
    triangle.vertices = {toShader(mesh[i]), toShader(mesh[i + 1]), toShader(mesh[i + 2])};
    object.insertTriangle(triangle);
  }
}

CSetOfTexturedTriangles::Ptr makeObject(const cv::Mat& image, bool lit) {
  const auto object = CSetOfTexturedTriangles::Create();
  object->assignImage(mrpt::img::CImage(image, mrpt::img::DEEP_COPY));
  object->enableTextureLinearInterpolation(true);
  object->enableLight(lit);
  return object;
}

/// Intrinsics of the finer image; libmrpt counts pixels from the corner, not the centre, of the top left one.
mrpt::img::TCamera fineCamera(const PinholeCamera& camera) {
  mrpt::img::TCamera fine;
  fine.ncols = static_cast<uint32_t>(fineness * camera.width);
  fine.nrows = static_cast<uint32_t>(fineness * camera.height);
  fine.setIntrinsicParamsFromValues(fineness * camera.fx, fineness * camera.fy, fineness * (camera.cx + 0.5),
                                    fineness * (camera.cy + 0.5));
  return fine;
}

std::unique_ptr<CFBORender> makeRenderer(int width, int height, bool is_first) {
  CFBORender::Parameters parameters(static_cast<unsigned>(width), static_cast<unsigned>(height));
  parameters.create_EGL_context = is_first;
  try {
    return std::make_unique<CFBORender>(parameters);
  } catch (const std::exception&) {
    throw std::runtime_error(
        "off-screen rendering is not available: it needs EGL, e.g. the packages libegl1 and libgl1-mesa-dri");
  }
}

/// Depth of each pixel: where its fine pixels lie on one surface, of its middle (inverse depth is linear on a plane);
/// at an edge, of what is in front.
cv::Mat coarseDepth(const mrpt::math::CMatrixFloat& fine) {
  cv::Mat depth(static_cast<int>(fine.rows()) / fineness, static_cast<int>(fine.cols()) / fineness, CV_32F);
  for (int row = 0; row < depth.rows; ++row)
    for (int column = 0; column < depth.cols; ++column) {
      float inverse_sum = 0, nearest = far_m, farthest = 0;
      for (int i = 0; i < fineness * fineness; ++i) {
        float z = fine(row * fineness + i / fineness, column * fineness + i % fineness);
        if (z <= 0) z = far_m;
        inverse_sum += 1 / z;
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
      }
      const bool is_edge = farthest - nearest > depth_edge * nearest;
      const float z = is_edge ? nearest : fineness * fineness / inverse_sum;
      depth.at<float>(row, column) = z < far_m ? z : 0;
    }
  return depth;
}

}  // namespace

struct SceneRenderer::State {
  State(const Scene& description, const Light& light, uint64_t seed, const std::vector<Surface>& surfaces)
      : context(makeRenderer(16, 16, true)), figure_surfaces(surfaces) {
    if (hasTracedLight(description)) tracer.emplace(trianglesOf(description), description.lamps, light);
    for (const Drawing& drawing : drawingsOf(description, light, seed, tracer ? &*tracer : nullptr)) {
      objects.push_back(makeObject(drawing.image, drawing.lit));
      setTriangles(*objects.back(), drawing.mesh);
    }
    if (!figure_surfaces.empty()) {
      figure_atlas = paintAtlas(figure_surfaces, std::vector<bool>(figure_surfaces.size(), true), ~seed);
      figures = makeObject(figure_atlas.image, tracer.has_value());
      objects.push_back(figures);
    }
    for (const auto& object : objects) scene.insert(object);
    lightUp(light);
  }

  void lightUp(const Light& light) {
    mrpt::opengl::COpenGLViewport& viewport = *scene.getViewport();
    viewport.setViewportClipDistances(near_m, far_m);
    mrpt::opengl::TLightParameters& shader = viewport.lightParameters();
    const auto channel = [&](int i) { return LightTracer::most * static_cast<float>(light.rgb[i]) / 255; };
    shader.ambient = {0, 0, 0, 1};
    shader.diffuse = {channel(0), channel(1), channel(2), 1};
    shader.direction = {0, 0, -1};
    if (!tracer) return;
    const auto sky = static_cast<float>(std::clamp(light.daylight, 0.0, 1.0));
    viewport.setCustomBackgroundColor({0.1f + 0.72f * sky, 0.11f + 0.77f * sky, 0.16f + 0.8f * sky});
  }

  CFBORender& rendererFor(const mrpt::img::TCamera& camera) {
    auto& renderer = renderers[{camera.ncols, camera.nrows}];
    if (!renderer) renderer = makeRenderer(static_cast<int>(camera.ncols), static_cast<int>(camera.nrows), false);
    return *renderer;
  }

  /// MRPT leaves out objects whose corners and middle are out of sight, though they may reach all around the camera.
  void keepInSight(const Rigid3& map_from_camera) {
    const auto point = toPoint((map_from_camera * Eigen::Vector3d(0, 0, 1)).cast<float>());
    for (const auto& object : objects) object->setLocalRepresentativePoint(point);
  }

  std::unique_ptr<CFBORender> context;  // first in, last out: the others hold memory of its context
  std::map<std::pair<uint32_t, uint32_t>, std::unique_ptr<CFBORender>> renderers;
  mrpt::opengl::COpenGLScene scene;
  std::vector<CSetOfTexturedTriangles::Ptr> objects;
  std::optional<LightTracer> tracer;
  std::vector<Surface> figure_surfaces;
  TextureAtlas figure_atlas;
  CSetOfTexturedTriangles::Ptr figures;
};

SceneRenderer::SceneRenderer(const Scene& scene, const Light& light, uint64_t texture_seed,
                             const std::vector<Surface>& figure_surfaces)
    : state_(std::make_unique<State>(scene, light, texture_seed, figure_surfaces)) {}

SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::setFigures(const std::vector<Face>& faces) {
  if (!state_->figures) return;
  DrawnMesh mesh = drawFaces(faces, state_->figure_surfaces, state_->figure_atlas, 1e9);
  if (state_->tracer) illuminateCoarsely(mesh, *state_->tracer);
  setTriangles(*state_->figures, mesh);
}

View SceneRenderer::render(const PinholeCamera& camera, const Rigid3& map_from_camera, bool with_depth) {
  PinholeCamera even = camera;
  even.width += even.width % 2;  // OpenGL fills rows up to four bytes, for which libmrpt leaves no room
  const mrpt::img::TCamera fine_camera = fineCamera(even);
  mrpt::opengl::CCamera eye;
  eye.setProjectiveFromPinhole(fine_camera);
  eye.set6DOFMode(true);
  mrpt::math::CMatrixDouble44 pose;
  pose.asEigen() = map_from_camera.matrix();
  eye.setPose(mrpt::poses::CPose3D(pose));
  CFBORender& renderer = state_->rendererFor(fine_camera);
  renderer.setCamera(state_->scene, eye);
  state_->keepInSight(map_from_camera);
  mrpt::img::CImage image;
  View view;
  if (with_depth) {
    mrpt::math::CMatrixFloat depth;
    renderer.render_RGBD(state_->scene, image, depth);
    view.depth = coarseDepth(depth);
  } else {
    renderer.render_RGB(state_->scene, image);
  }
  cv::resize(image.asCvMatRef(), view.bgr, {}, 1.0 / fineness, 1.0 / fineness, cv::INTER_AREA);
  if (even.width != camera.width) {
    view.bgr = view.bgr.colRange(0, camera.width).clone();
    if (with_depth) view.depth = view.depth.colRange(0, camera.width).clone();
  }
  return view;
}

}  // namespace vmcl
