// SPDX-License-Identifier: BSD-3-Clause
#include "scene_renderer.h"

#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CTexturedPlane.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "texture_atlas.h"

namespace vmcl {
namespace {

constexpr int fineness = 2;            // drawn pixels per image pixel and axis
constexpr int max_texture_px = 16384;  // side of a texture that Mesa draws
constexpr float near_m = 0.03f, far_m = 150.0f;

mrpt::math::TPoint3Df toPoint(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// All faces of a scene as one object with one texture: MRPT gives each texture a unit of the hardware of its own, and
/// those are few.
class SceneMesh final : public mrpt::opengl::CTexturedPlane {
 public:
  SceneMesh(const Scene& scene, const TextureAtlas& atlas) {
    for (const Face& face : scene.faces) addFace(scene.surfaces[face.surface], face, atlas);
    assignImage(mrpt::img::CImage(atlas.image, mrpt::img::DEEP_COPY));
    enableTextureLinearInterpolation(true);
  }

  void onUpdateBuffers_TexturedTriangles() override { CRenderizableShaderTexturedTriangles::m_triangles = triangles_; }

 private:
  using Corner = mrpt::opengl::TTriangle::Vertex;

  void addFace(const Surface& surface, const Face& face, const TextureAtlas& atlas) {
    const cv::Rect& place = atlas.places[face.surface];
    const auto corner = [&](double x, double y) {
      Corner vertex;
      vertex.xyzrgba.pt = toPoint(face.map_from_face * Eigen::Vector3d(x, y, 0));
      const double column = place.x + place.width * (face.offset.x() + x) / surface.width;
      const double row = place.y + place.height * (1 - (face.offset.y() + y) / surface.height);
      vertex.uv = {static_cast<float>(column / atlas.image.cols), static_cast<float>(row / atlas.image.rows)};
      return vertex;
    };
    const Corner a = corner(0, 0), b = corner(face.width, 0), c = corner(face.width, face.height),
                 d = corner(0, face.height);
    addTriangle(a, b, c);
    addTriangle(a, c, d);
  }

  void addTriangle(const Corner& a, const Corner& b, const Corner& c) {
    mrpt::opengl::TTriangle triangle;
    triangle.vertices = {a, b, c};
    triangles_.push_back(triangle);
  }

  std::vector<mrpt::opengl::TTriangle> triangles_;
};

/// Intrinsics of the finer image; libmrpt counts pixels from the corner, not the centre, of the top left one.
mrpt::img::TCamera fineCamera(const PinholeCamera& camera) {
  mrpt::img::TCamera fine;
  fine.ncols = static_cast<uint32_t>(fineness * camera.width);
  fine.nrows = static_cast<uint32_t>(fineness * camera.height);
  fine.setIntrinsicParamsFromValues(fineness * camera.fx, fineness * camera.fy, fineness * (camera.cx + 0.5),
                                    fineness * (camera.cy + 0.5));
  return fine;
}

std::vector<cv::Mat> paintSurfaces(const Scene& scene, const Light& light, uint64_t seed) {
  std::vector<cv::Mat> images;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    images.push_back(paintSurface(scene.surfaces[i], light, seed, i));
  return images;
}

std::unique_ptr<mrpt::opengl::CFBORender> makeRenderer(const mrpt::img::TCamera& camera) {
  try {
    return std::make_unique<mrpt::opengl::CFBORender>(camera.ncols, camera.nrows);
  } catch (const std::exception&) {
    throw std::runtime_error(
        "off-screen rendering is not available: it needs EGL, e.g. the packages libegl1 and libgl1-mesa-dri");
  }
}

}  // namespace

struct SceneRenderer::State {
  State(const Scene& description, const TextureAtlas& atlas, const PinholeCamera& pinhole)
      : renderer(makeRenderer(fineCamera(pinhole))), mesh(std::make_shared<SceneMesh>(description, atlas)) {
    camera.setProjectiveFromPinhole(fineCamera(pinhole));
    camera.set6DOFMode(true);
    scene.getViewport()->setViewportClipDistances(near_m, far_m);
    scene.insert(mesh);
  }

  void look(const Rigid3& map_from_camera) {
    mrpt::math::CMatrixDouble44 pose;
    pose.asEigen() = map_from_camera.matrix();
    camera.setPose(mrpt::poses::CPose3D(pose));
    renderer->setCamera(scene, camera);
    mesh->setLocalRepresentativePoint(toPoint(map_from_camera * Eigen::Vector3d(0, 0, 1)));  // or it may be culled
  }

  std::unique_ptr<mrpt::opengl::CFBORender> renderer;  // first in, last out: the others hold memory of its context
  mrpt::opengl::COpenGLScene scene;
  std::shared_ptr<SceneMesh> mesh;
  mrpt::opengl::CCamera camera;
};

SceneRenderer::SceneRenderer(const Scene& scene, const Light& light, uint64_t texture_seed, const PinholeCamera& camera)
    : state_(std::make_unique<State>(scene, packAtlas(paintSurfaces(scene, light, texture_seed), max_texture_px),
                                     camera)) {}

SceneRenderer::~SceneRenderer() = default;

cv::Mat SceneRenderer::render(const Rigid3& map_from_camera) {
  state_->look(map_from_camera);
  mrpt::img::CImage image;
  state_->renderer->render_RGB(state_->scene, image);
  cv::Mat coarse;
  cv::resize(image.asCvMatRef(), coarse, {}, 1.0 / fineness, 1.0 / fineness, cv::INTER_AREA);
  return coarse;
}

}  // namespace vmcl
