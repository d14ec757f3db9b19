// SPDX-License-Identifier: BSD-3-Clause
#include "model_mesh.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <stdexcept>

namespace vmcl {
namespace {

constexpr std::size_t max_vertices = 30'000'000;

Eigen::Vector3f toEigen(const aiVector3D& v) { return {v.x, v.y, v.z}; }

ModelPart materialOf(const aiMaterial& material, const std::filesystem::path& file) {
  ModelPart part;
  aiString name;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) == AI_SUCCESS) {
    const auto texture = (file.parent_path() / name.C_Str()).lexically_normal();
    if (std::filesystem::is_regular_file(texture))
      part.texture = texture;
    else
      part.missing_texture = texture;
  }
  aiColor4D color;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS)
    for (int i = 0; i < 3; ++i) part.rgb[i] = static_cast<int>(255 * std::clamp(color[i], 0.0f, 1.0f));
  return part;
}

void addTriangles(ModelPart& part, const aiMesh& mesh) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const unsigned index = face.mIndices[corner];
      const aiVector3D uv = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][index] : aiVector3D();
      part.vertices.push_back({toEigen(mesh.mVertices[index]), toEigen(mesh.mNormals[index]), {uv.x, uv.y}});
    }
  }
}

}  // namespace

ModelMesh readModelMesh(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw std::runtime_error(file.string() + ": there is no such mesh");
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                                              aiProcess_GenSmoothNormals | aiProcess_SortByPType |
                                                              aiProcess_FlipUVs | aiProcess_ValidateDataStructure);
  if (!scene) throw std::runtime_error(file.string() + ": " + importer.GetErrorString());
  ModelMesh model;
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) model.parts.push_back(materialOf(*scene->mMaterials[i], file));
  std::size_t vertices = 0;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    vertices += std::size_t{3} * mesh.mNumFaces;
    if (vertices > max_vertices) throw std::runtime_error(file.string() + ": has over ten million triangles");
    addTriangles(model.parts.at(mesh.mMaterialIndex), mesh);
  }
  std::erase_if(model.parts, [](const ModelPart& part) { return part.vertices.empty(); });
  if (model.parts.empty()) throw std::runtime_error(file.string() + ": has no triangles");
  for (const ModelPart& part : model.parts)
    for (const ModelPart::Vertex& vertex : part.vertices)
      if (!vertex.point.allFinite() || !vertex.uv.allFinite())
        throw std::runtime_error(file.string() + ": a vertex is not finite");
  return model;
}

}  // namespace vmcl
