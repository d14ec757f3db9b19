// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace vmcl {

/// The part of a mesh that shows one image, or one colour where there is no image.
struct ModelPart {
  std::filesystem::path texture;
  std::filesystem::path missing_texture;  ///< an image that the file names and that is not there
  std::array<int, 3> rgb{200, 200, 200};

  struct Vertex {
    Eigen::Vector3f point;
    Eigen::Vector3f normal;
    Eigen::Vector2f uv;  ///< v downwards, as in images
  };
  std::vector<Vertex> vertices;  ///< three a triangle
};

/// A mesh file, in its own frame, metres.
struct ModelMesh {
  std::vector<ModelPart> parts;
};

/// Reads any format that Assimp knows; axes are left as they are in the file. Throws std::runtime_error naming the
/// file and the reason.
ModelMesh readModelMesh(const std::filesystem::path& file);

}  // namespace vmcl
