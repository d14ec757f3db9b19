// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/scene_renderer.h"

#include <gtest/gtest.h>

#include "simulation/laser_scanner.h"
#include "simulation/shapes.h"
#include "simulation/walls.h"

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const PinholeCamera camera{320, 240, 260, 250, 151.3, 123.8};

/// Nothing where off-screen drawing is not possible.
std::optional<cv::Mat> render(const Scene& scene, const Rigid3& map_from_camera) {
  try {
    return SceneRenderer(scene, {}, 1).render(camera, map_from_camera).bgr;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("off-screen rendering is not available"), std::string::npos)
        << error.what();
    return std::nullopt;
  }
}

#define RENDER_OR_SKIP(image, scene, pose)                                          \
  const auto image##_if_possible = render(scene, pose);                             \
  if (!image##_if_possible) GTEST_SKIP() << "no off-screen rendering on this host"; \
  const cv::Mat image = *image##_if_possible

/// A camera at this place of the map, looking along the heading, turned down by `pitch` and about its axis by `roll`.
Rigid3 cameraAt(const Vector3d& place, double heading, double pitch, double roll) {
  Eigen::Matrix3d level_from_optical;
  level_from_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Rigid3 map_from_camera = Rigid3::Identity();
  map_from_camera.translate(place);
  map_from_camera.rotate(Eigen::AngleAxisd(heading, Vector3d::UnitZ()));
  map_from_camera.rotate(Eigen::AngleAxisd(pitch, Vector3d::UnitY()));
  map_from_camera.rotate(Eigen::AngleAxisd(roll, Vector3d::UnitX()));
  map_from_camera.rotate(level_from_optical);
  return map_from_camera;
}

void addPlain(Scene& scene, const Solid& solid, const std::array<int, 3>& rgb) {
  addBox(scene, scene.addObject("box"), solid, {"plain", rgb}, {});
}

/// Mean position of what is much redder than green.
Vector2d centreOfRed(const cv::Mat& image) {
  Vector2d sum = Vector2d::Zero();
  double weight = 0;
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const auto pixel = image.at<cv::Vec3b>(v, u);
      const double red = std::max(0, pixel[2] - pixel[1] - 10);
      sum += red * Vector2d(u, v);
      weight += red;
    }
  return sum / weight;
}

TEST(SceneRenderer, agreesWithThePinholeCamera) {
  const Rigid3 map_from_camera = cameraAt({0.3, -0.2, 0.5}, 0.4, -0.1, 0.15);
  for (const Vector2d& pixel : {Vector2d(40, 30), Vector2d(160, 120), Vector2d(290, 60), Vector2d(80, 210)}) {
    const Vector3d point = map_from_camera * (3.0 * camera.ray(pixel));
    Scene scene;
    addPlain(scene, {{point.x(), point.y(), 0.4}, {0.001, 0.04}, point.z() - 0.04, point.z() + 0.04}, {255, 0, 0});
    RENDER_OR_SKIP(image, scene, map_from_camera);
    EXPECT_LT((centreOfRed(image) - pixel).norm(), 0.1) << pixel.transpose();
  }
}

TEST(SceneRenderer, edgesLieWhereCornersProject) {
  const Rigid3 map_from_camera = cameraAt({0, 0, 0.5}, 0, 0, 0);
  Scene scene;
  addPlain(scene, {{2.1, 0.2, 0}, {0.1, 0.4}, 0.3, 0.9}, {255, 0, 0});
  RENDER_OR_SKIP(image, scene, map_from_camera);
  const auto pixelOf = [&](double y, double z) {
    return camera.project(map_from_camera.inverse() * Vector3d(2.0, y, z));
  };
  const auto isRed = [&](double u, double v) {
    const auto pixel = image.at<cv::Vec3b>(static_cast<int>(std::lround(v)), static_cast<int>(std::lround(u)));
    return pixel[2] > 120 && pixel[1] < 60;
  };
  const Vector2d low = pixelOf(0.6, 0.9), high = pixelOf(-0.2, 0.3), middle = (low + high) / 2;
  EXPECT_TRUE(isRed(low.x() + 1, middle.y()) && !isRed(low.x() - 1, middle.y()));
  EXPECT_TRUE(isRed(high.x() - 1, middle.y()) && !isRed(high.x() + 1, middle.y()));
  EXPECT_TRUE(isRed(middle.x(), low.y() + 1) && !isRed(middle.x(), low.y() - 1));
  EXPECT_TRUE(isRed(middle.x(), high.y() - 1) && !isRed(middle.x(), high.y() + 1));
}

TEST(SceneRenderer, seesWhatTheLaserHits) {
  Scene scene;
  addPlain(scene, {{5, 0, 0}, {0.1, 10}, 0, 3}, {0, 220, 0});
  for (const Vector2d& center : {Vector2d(3, 1), Vector2d(2, -0.5), Vector2d(4, 0.2)})
    addPlain(scene, {{center.x(), center.y(), 0}, {0.3, 0.3}, 0, 1}, {220, 0, 0});
  RENDER_OR_SKIP(image, scene, cameraAt({0, 0, 0.5}, 0.1, 0, 0));
  const int row = static_cast<int>(std::lround(camera.cy));
  const auto triangles = trianglesOf(scene);
  const auto range = [&](double column) {
    Rigid3 map_from_ray = toRigid3(PlanarPose{0, 0, 0.1 - std::atan((column - camera.cx) / camera.fx)});
    map_from_ray.translation().z() = 0.5;
    LaserSweep ray({.rays = 1}, map_from_ray);
    ray.add(triangles);
    return ray.distances().front();
  };
  int on_boxes = 0;
  for (int column = 1; column + 1 < camera.width; ++column) {
    if (std::abs(range(column - 1) - range(column + 1)) > 0.2) continue;  // an edge
    const double angle = 0.1 - std::atan((column - camera.cx) / camera.fx);
    const bool box = range(column) * std::cos(angle) < 4.8;
    const auto pixel = image.at<cv::Vec3b>(row, column);
    EXPECT_EQ(pixel[2] > pixel[1], box) << "column " << column;
    on_boxes += box;
  }
  EXPECT_GT(on_boxes, 50);
}

TEST(SceneRenderer, drawsDecorationsUprightAndUnmirrored) {
  // On the left side of a wall, what is near its start is seen on the right.
  Wall wall{"wall", {3, -2, std::numbers::pi / 2}, 4, 0.1, 2, {"plain", {0, 200, 0}}, {"plain", {0, 200, 0}}, {}, {},
            {}};
  wall.left_decorations = {{"door", {0.8, 1.5}, {0.6, 0.6}}};
  Scene scene;
  addWall(scene, wall);
  RENDER_OR_SKIP(image, scene, cameraAt({0, 0, 1}, 0, 0, 0));
  const Vector2d expected = camera.project(cameraAt({0, 0, 1}, 0, 0, 0).inverse() * Vector3d(2.95, -2 + 0.8, 1.5));
  EXPECT_LT((centreOfRed(image) - expected).norm(), 3);
}

/// A white floor of 4 m x 4 m around the origin with a lamp 2 m above it, seen from above.
Scene litFloor() {
  Scene scene;
  addSide(scene, scene.addObject("floor"), {{0, 0, 0}, {2, 2}, -0.1, 0}, Side::top, {"plain", {200, 200, 200}});
  scene.lamps.push_back({Lamp::Kind::lamp, {0, 0, 2}, {0.05, 0, 0}, {0, 0.05, 0}, 1});
  return scene;
}

Rigid3 fromAbove() { return cameraAt({0, 0, 3.5}, 0, std::numbers::pi / 2, 0); }

double brightnessAt(const cv::Mat& image, double x, double y) {
  const Vector2d pixel = camera.project(fromAbove().inverse() * Vector3d(x, y, 0));
  const cv::Rect around(static_cast<int>(pixel.x()) - 3, static_cast<int>(pixel.y()) - 3, 7, 7);
  return cv::mean(image(around))[1];
}

TEST(SceneRenderer, lampsLightWhatIsNearAndThingsCastShadows) {
  Scene scene = litFloor();
  RENDER_OR_SKIP(bare, scene, fromAbove());
  EXPECT_GT(brightnessAt(bare, 0, 0), brightnessAt(bare, 1.5, 0) + 10);
  addPlain(scene, {{0.5, 0, 0}, {0.05, 0.5}, 0.3, 1.2}, {200, 200, 200});
  RENDER_OR_SKIP(shadowed, scene, fromAbove());
  EXPECT_LT(brightnessAt(shadowed, 1.1, 0), brightnessAt(bare, 1.1, 0) - 20);
  EXPECT_NEAR(brightnessAt(shadowed, -1.1, 0), brightnessAt(bare, -1.1, 0), 3);
}

TEST(SceneRenderer, measuresDepthAndShowsFigures) {
  Scene scene;
  addPlain(scene, {{3.1, 0, 0}, {0.1, 4}, 0, 3}, {200, 200, 200});
  const std::vector<Surface> looks{{1, 1, {"plain", {220, 0, 0}}, {}, Vector3d::UnitX(), 50}};
  std::vector<Face> figure;
  addLimb(figure, {{2, 0.5, 0}, {2, 0.5, 2}, 0.2, 0.2}, 0, 1, 1);
  std::optional<SceneRenderer> renderer;
  try {
    renderer.emplace(scene, Light{}, 1, looks);
  } catch (const std::runtime_error&) {
    GTEST_SKIP() << "no off-screen rendering on this host";
  }
  PinholeCamera odd = camera;  // OpenGL pads rows of odd width
  odd.width = 317;
  const Rigid3 pose = cameraAt({0, 0, 1}, 0, 0, 0);
  renderer->setFigures(figure);
  const View with = renderer->render(odd, pose, true);
  ASSERT_EQ(with.depth.size(), cv::Size(317, 240));
  ASSERT_EQ(with.bgr.size(), cv::Size(317, 240));
  const Vector2d wall = camera.project(pose.inverse() * Vector3d(3, -0.8, 1)),
                 person = camera.project(pose.inverse() * Vector3d(1.8, 0.45, 1));
  const auto depthAt = [](const View& view, const Vector2d& pixel) {
    return view.depth.at<float>(static_cast<int>(pixel.y()), static_cast<int>(pixel.x()));
  };
  EXPECT_NEAR(depthAt(with, wall), 3, 0.01);
  EXPECT_NEAR(depthAt(with, person), 1.8, 0.02);
  const auto color = with.bgr.at<cv::Vec3b>(static_cast<int>(person.y()), static_cast<int>(person.x()));
  EXPECT_GT(color[2], color[1] + 50);
  renderer->setFigures({});
  EXPECT_NEAR(depthAt(renderer->render(odd, pose, true), person), 3, 0.01);
}

}  // namespace
}  // namespace vmcl
