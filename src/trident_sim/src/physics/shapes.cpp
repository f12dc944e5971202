// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <vector>

#include "height_image.h"
#include "trident_base/error.h"

namespace trident {
namespace {

struct TriangleSoup {
  std::vector<float> vertices;  ///< x y z
  std::vector<dTriIndex> indices;
};

void append_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& T_root_parent,
                 const Eigen::Vector3d& scale, TriangleSoup& soup) {
  const aiMatrix4x4 T_root_node = T_root_parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    const auto first = static_cast<dTriIndex>(soup.vertices.size() / 3);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = T_root_node * mesh.mVertices[v];
      soup.vertices.push_back(static_cast<float>(p.x * scale.x()));
      soup.vertices.push_back(static_cast<float>(p.y * scale.y()));
      soup.vertices.push_back(static_cast<float>(p.z * scale.z()));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;
      for (int i = 0; i < 3; ++i) soup.indices.push_back(first + mesh.mFaces[f].mIndices[i]);
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    append_node(scene, *node.mChildren[c], T_root_node, scale, soup);
  }
}

TriangleSoup read_mesh(const MeshShape& shape, const std::string& scoped_name) {
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(shape.file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error("collision '" + scoped_name + "': mesh '" + shape.file +
                "' cannot be read: " + importer.GetErrorString());
  }
  TriangleSoup soup;
  append_node(*scene, *scene->mRootNode, aiMatrix4x4(), shape.scale, soup);
  if (soup.indices.empty()) {
    throw Error("collision '" + scoped_name + "': mesh '" + shape.file + "' has no triangles");
  }
  return soup;
}

dGeomID make_mesh(const MeshShape& shape, const std::string& scoped_name, dTriMeshDataID& data) {
  const TriangleSoup soup = read_mesh(shape, scoped_name);
  // ODE keeps pointers, not copies: the arrays live as long as the mesh data, which owns them
  // through its user pointer (see destroy_geom).
  auto* owned = new TriangleSoup(soup);
  data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildSingle(data, owned->vertices.data(), 3 * sizeof(float),
                              static_cast<int>(owned->vertices.size() / 3), owned->indices.data(),
                              static_cast<int>(owned->indices.size()), 3 * sizeof(dTriIndex));
  dGeomID id = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
  dGeomSetData(id, owned);
  return id;
}

/// Below the lowest sample the ground is this thick [m], as in Gazebo: what has sunk in deeper
/// falls.
constexpr double kGroundThickness = 1.0;

/// A field over the shape's x and y, centred on its origin; the top of the picture lies at +y. As
/// in Gazebo the brightest pixel is at size.z, black at zero.
dGeomID make_heightmap(const HeightmapShape& shape, const std::string& scoped_name,
                       dHeightfieldDataID& data) {
  HeightImage image;
  try {
    image = read_height_image(shape.file);
  } catch (const Error& error) {
    throw Error("collision '" + scoped_name + "': heightmap: " + error.what());
  }
  std::vector<float>& heights = image.brightness;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const double scale = *high > 0.0F ? shape.size.z() / *high : 0.0;
  const double lowest = scale * *low, highest = scale * *high;
  data = dGeomHeightfieldDataCreate();
  for (float& height : heights) height = static_cast<float>(scale * height);
  dGeomHeightfieldDataBuildSingle(data, heights.data(), 1, shape.size.x(), shape.size.y(),
                                  image.columns, image.rows, 1.0, 0.0, kGroundThickness, 0);
  dGeomHeightfieldDataSetBounds(data, lowest, highest);
  return dCreateHeightfield(nullptr, data, 1);
}

/// ODE's heightfields stand on their x-z plane.
const Eigen::Quaterniond kUpright(std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0);

}  // namespace

bool must_be_static(const Geom& geom) {
  const int kind = dGeomGetClass(geom.id);
  return kind == dPlaneClass || kind == dHeightfieldClass;
}

Geom make_geom(const CollisionSpec& spec, const std::string& scoped_name) {
  Geom geom;
  geom.name = scoped_name;
  geom.surface = spec.surface;
  struct Maker {
    Geom& geom;
    dGeomID operator()(const BoxShape& s) const {
      return dCreateBox(nullptr, s.size.x(), s.size.y(), s.size.z());
    }
    dGeomID operator()(const SphereShape& s) const { return dCreateSphere(nullptr, s.radius); }
    dGeomID operator()(const CylinderShape& s) const {
      return dCreateCylinder(nullptr, s.radius, s.length);
    }
    dGeomID operator()(const CapsuleShape& s) const {
      return dCreateCapsule(nullptr, s.radius, s.length);
    }
    dGeomID operator()(const PlaneShape& s) const {
      return dCreatePlane(nullptr, s.normal.x(), s.normal.y(), s.normal.z(), 0.0);
    }
    dGeomID operator()(const MeshShape& s) const { return make_mesh(s, geom.name, geom.mesh); }
    dGeomID operator()(const HeightmapShape& s) const {
      return make_heightmap(s, geom.name, geom.heightfield);
    }
  };
  geom.id = std::visit(Maker{geom}, spec.shape);
  return geom;
}

void destroy_geom(Geom& geom) {
  if (geom.id == nullptr) return;
  auto* soup = static_cast<TriangleSoup*>(geom.mesh != nullptr ? dGeomGetData(geom.id) : nullptr);
  dGeomDestroy(geom.id);
  if (geom.mesh != nullptr) dGeomTriMeshDataDestroy(geom.mesh);
  if (geom.heightfield != nullptr) dGeomHeightfieldDataDestroy(geom.heightfield);
  delete soup;
  geom.id = nullptr;
  geom.mesh = nullptr;
  geom.heightfield = nullptr;
}

void place_static_geom(Geom& geom, const SE3& T_world_shape) {
  if (dGeomGetClass(geom.id) == dPlaneClass) {
    dVector4 local;
    dGeomPlaneGetParams(geom.id, local);
    const Eigen::Vector3d normal =
        (T_world_shape.R * Eigen::Vector3d(local[0], local[1], local[2])).normalized();
    dGeomPlaneSetParams(geom.id, normal.x(), normal.y(), normal.z(), normal.dot(T_world_shape.p));
    return;
  }
  dGeomSetPosition(geom.id, T_world_shape.p.x(), T_world_shape.p.y(), T_world_shape.p.z());
  const Eigen::Quaterniond R = dGeomGetClass(geom.id) == dHeightfieldClass
                                   ? Eigen::Quaterniond(T_world_shape.R * kUpright)
                                   : T_world_shape.R;
  const dQuaternion q = {R.w(), R.x(), R.y(), R.z()};
  dGeomSetQuaternion(geom.id, q);
}

}  // namespace trident
