// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/light.h"

#include <gtest/gtest.h>

#include "simulation/shapes.h"
#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TEST(TriangleTree, agreesWithTryingAllTriangles) {
  Random random(8);
  const auto point = [&](double size) {
    return Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const Vector3d center = point(3);
    triangles.push_back({{center + point(0.4), center + point(0.4), center + point(0.4)}, 0});
  }
  const TriangleTree tree(triangles);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3f origin = point(4).cast<float>(), direction = point(1).cast<float>().normalized();
    std::optional<float> nearest;
    for (const Triangle& triangle : triangles)
      if (const auto hit = TriangleTree({triangle}).firstHit(origin, direction, nearest.value_or(20))) nearest = hit;
    const auto found = tree.firstHit(origin, direction, 20);
    ASSERT_EQ(found.has_value(), nearest.has_value());
    if (!found) continue;
    EXPECT_NEAR(*found, *nearest, 1e-5);
    ++hits;
  }
  EXPECT_GT(hits, 100);
}

Scene roomWithLamp() {
  Scene scene;
  addSide(scene, scene.addObject("floor"), {{0, 0, 0}, {4, 4}, -0.1, 0}, Side::top, {"plain", {}});
  scene.lamps.push_back({Lamp::Kind::lamp, {0, 0, 2}, {0.1, 0, 0}, {0, 0.1, 0}, 1});
  return scene;
}

TEST(LightTracer, dimsWithDistanceAndBehindThings) {
  Scene scene = roomWithLamp();
  const Light light;
  const LightTracer open(trianglesOf(scene), scene.lamps, light);
  const Vector3d up = Vector3d::UnitZ();
  EXPECT_GT(open.at({0, 0, 0}, up), open.at({1.5, 0, 0}, up));
  addBox(scene, scene.addObject("board"), {{0.6, 0, 0}, {0.02, 0.6}, 0.4, 1.9}, {"plain", {}}, {});
  const LightTracer shaded(trianglesOf(scene), scene.lamps, light);
  EXPECT_LT(shaded.at({1.2, 0, 0}, up), 0.75 * open.at({1.2, 0, 0}, up));
  EXPECT_NEAR(shaded.at({-1.2, 0, 0}, up), open.at({-1.2, 0, 0}, up), 0.02);
}

TEST(LightTracer, lampsCanBeOffAndWindowsShineByDay) {
  Scene scene = roomWithLamp();
  const auto lit = [&](double lamps, double daylight) {
    Light light;
    light.lamps = lamps;
    light.daylight = daylight;
    return LightTracer(trianglesOf(scene), scene.lamps, light).at({0.5, 0.5, 0}, Vector3d::UnitZ());
  };
  EXPECT_GT(lit(1, 0), lit(0.2, 0));
  EXPECT_GT(lit(0.2, 0), lit(0, 0));
  scene.lamps[0].kind = Lamp::Kind::window;
  scene.lamps[0].half_up = {0, 0, 0.5};
  EXPECT_GT(lit(0, 1), lit(0, 0.1));
}

TEST(LightTracer, cornersAreDarkerThanTheMiddle) {
  Scene scene = roomWithLamp();
  addBox(scene, scene.addObject("wall"), {{2, 0, 0}, {0.1, 3}, 0, 2.5}, {"plain", {}}, {});
  scene.lamps.clear();
  const LightTracer tracer(trianglesOf(scene), scene.lamps, {});
  EXPECT_LT(tracer.at({1.85, 0, 0}, Vector3d::UnitZ()), 0.95 * tracer.at({0, 0, 0}, Vector3d::UnitZ()));
}

}  // namespace
}  // namespace vmcl
