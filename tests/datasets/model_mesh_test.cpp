// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/model_mesh.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "scratch_directory.h"

namespace vmcl {
namespace {

class ModelMeshTest : public testing::Test {
 protected:
  ModelMeshTest() {
    std::ofstream(scratch_.path() / "plate.mtl") << "newmtl m\nKd 1 0.5 0\nmap_Kd plate.png\n";
    std::ofstream(mesh()) << "mtllib plate.mtl\nusemtl m\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                             "vt 0 1\nf 1/1 2/2 3/3 4/4\n";
  }
  std::filesystem::path mesh() const { return scratch_.path() / "plate.obj"; }

  ScratchDirectory scratch_;
};

TEST_F(ModelMeshTest, readsTrianglesImageAndColour) {
  cv::imwrite(scratch_.path() / "plate.png", cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(99)));
  const ModelMesh model = readModelMesh(mesh());
  ASSERT_EQ(model.parts.size(), 1u);
  const ModelPart& part = model.parts[0];
  EXPECT_EQ(part.texture, scratch_.path() / "plate.png");
  EXPECT_EQ(part.rgb, (std::array<int, 3>{255, 127, 0}));
  ASSERT_EQ(part.vertices.size(), 6u);
  for (const auto& vertex : part.vertices) {
    EXPECT_NEAR(vertex.normal.z(), 1, 1e-6);
    EXPECT_NEAR(vertex.uv.x(), vertex.point.x() / 2, 1e-6);
    EXPECT_NEAR(vertex.uv.y(), 1 - vertex.point.y(), 1e-6);  // downwards, as in images
  }
}

TEST_F(ModelMeshTest, notesAnImageThatIsMissing) {
  const ModelMesh model = readModelMesh(mesh());
  EXPECT_TRUE(model.parts[0].texture.empty());
  EXPECT_EQ(model.parts[0].missing_texture, scratch_.path() / "plate.png");
}

TEST_F(ModelMeshTest, refusesWhatIsNoMesh) {
  const auto failure = [&] {
    try {
      readModelMesh(mesh());
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no failure");
  };
  std::ofstream(mesh()) << "garbage";
  EXPECT_EQ(failure().find(mesh().string() + ": "), 0u) << failure();
  std::filesystem::remove(mesh());
  EXPECT_NE(failure().find("there is no such mesh"), std::string::npos);
}

}  // namespace
}  // namespace vmcl
