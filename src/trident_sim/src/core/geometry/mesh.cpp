// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

class MeshReader {
 public:
  MeshReader(const aiScene& scene, const MeshShape& shape, MeshDetail detail)
      : scene_(scene), shape_(shape), detail_(detail) {}

  TriangleMesh run() {
    if (detail_ == MeshDetail::kLook) add_materials();
    add_node(*scene_.mRootNode, aiMatrix4x4());
    if (!has_normals_) mesh_.normals.clear();
    if (!has_uvs_) mesh_.uvs.clear();
    return std::move(mesh_);
  }

 private:
  // Parts are placed by the transforms of all nodes
  // above them; scale is applied last, in mesh axes.
  void add_node(const aiNode& node, const aiMatrix4x4& T_root_parent) {
    const aiMatrix4x4 T_root_node = T_root_parent * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
      const aiMesh& part = *scene_.mMeshes[node.mMeshes[m]];
      const auto first = static_cast<std::uint32_t>(mesh_.vertex_count());
      add_vertices(part, T_root_node);
      if (detail_ == MeshDetail::kLook) add_look(part, T_root_node);
      add_faces(part, first);
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c) add_node(*node.mChildren[c], T_root_node);
  }

  void add_vertices(const aiMesh& part, const aiMatrix4x4& T_root_node) {
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D p = T_root_node * part.mVertices[v];
      mesh_.vertices.push_back(static_cast<float>(p.x * shape_.scale.x()));
      mesh_.vertices.push_back(static_cast<float>(p.y * shape_.scale.y()));
      mesh_.vertices.push_back(static_cast<float>(p.z * shape_.scale.z()));
    }
  }

  /// Zero where the file gives none, or none that can be used.
  Eigen::Vector3d normal_of(const aiMesh& part, unsigned vertex,
                            const aiMatrix3x3& to_normal) const {
    if (!part.HasNormals()) return Eigen::Vector3d::Zero();
    const aiVector3D n = to_normal * part.mNormals[vertex];
    Eigen::Vector3d normal =
        Eigen::Vector3d(n.x, n.y, n.z).cwiseQuotient(shape_.scale).normalized();
    if (!normal.allFinite()) normal.setZero();
    return normal;
  }

  /// Normals go with the inverse transpose of what moves the points.
  void add_look(const aiMesh& part, const aiMatrix4x4& T_root_node) {
    const aiMatrix3x3 to_normal = aiMatrix3x3(T_root_node).Inverse().Transpose();
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const Eigen::Vector3d normal = normal_of(part, v, to_normal);
      for (int i = 0; i < 3; ++i) mesh_.normals.push_back(static_cast<float>(normal[i]));
      const aiVector3D uv = part.HasTextureCoords(0) ? part.mTextureCoords[0][v] : aiVector3D();
      mesh_.uvs.push_back(uv.x);
      mesh_.uvs.push_back(uv.y);
    }
    has_normals_ = has_normals_ || part.HasNormals();
    has_uvs_ = has_uvs_ || part.HasTextureCoords(0);
  }

  void add_faces(const aiMesh& part, std::uint32_t first) {
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      // Triangulation leaves points and lines as they are; they have no surface.
      if (part.mFaces[f].mNumIndices != 3) continue;
      for (int i = 0; i < 3; ++i) mesh_.indices.push_back(first + part.mFaces[f].mIndices[i]);
      if (detail_ == MeshDetail::kLook) mesh_.triangle_materials.push_back(part.mMaterialIndex);
    }
  }

  void add_materials() {
    for (unsigned m = 0; m < scene_.mNumMaterials; ++m) {
      mesh_.materials.push_back(read_material(*scene_.mMaterials[m]));
    }
  }

  /// Not the opacity: exporters of COLLADA do not agree whether 0 or 1 is clear.
  Material read_material(const aiMaterial& from) const {
    Material material;
    const auto read = [&from](const char* key, unsigned type, unsigned index,
                              Eigen::Vector4d& color) {
      aiColor4D rgba;
      if (from.Get(key, type, index, rgba) != AI_SUCCESS) return;
      color = Eigen::Vector4d(rgba.r, rgba.g, rgba.b, rgba.a).cwiseMax(0.0).cwiseMin(1.0);
    };
    read(AI_MATKEY_COLOR_DIFFUSE, material.diffuse);
    material.ambient = material.diffuse;
    read(AI_MATKEY_COLOR_SPECULAR, material.specular);
    read(AI_MATKEY_COLOR_EMISSIVE, material.emissive);
    aiString picture;
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &picture) == AI_SUCCESS) {
      const auto folder = std::filesystem::path(shape_.file).parent_path();
      material.texture_file = (folder / picture.C_Str()).lexically_normal().string();
    }
    material.is_given = true;
    return material;
  }

  const aiScene& scene_;
  const MeshShape& shape_;
  MeshDetail detail_;
  TriangleMesh mesh_;
  bool has_normals_ = false, has_uvs_ = false;
};

}  // namespace

TriangleMesh read_mesh(const MeshShape& shape, MeshDetail detail) {
  Assimp::Importer importer;
  // As Gazebo: vertices are taken as they are, whatever axis the file calls up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer.ReadFile(shape.file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error("mesh '" + shape.file + "' cannot be read: " + importer.GetErrorString());
  }
  TriangleMesh mesh = MeshReader(*scene, shape, detail).run();
  if (mesh.indices.empty()) throw Error("mesh '" + shape.file + "' has no triangles");
  return mesh;
}

}  // namespace trident::sim
