// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/contacts/contact_margin.h"
#include "core/geometry/mesh.h"
#include "height_image.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

dGeomID make_mesh(const MeshShape& shape, const std::string& scoped_name, dTriMeshDataID& data) {
  static_assert(sizeof(dTriIndex) == sizeof(std::uint32_t));
  std::unique_ptr<TriangleMesh> mesh;
  try {
    std::optional<TriangleMesh> prepared = take_prepared_mesh(shape);
    mesh = std::make_unique<TriangleMesh>(prepared ? std::move(*prepared)
                                                   : read_mesh(shape, MeshDetail::kShape));
  } catch (const Error& error) {
    throw Error("collision '" + scoped_name + "': " + error.what());
  }
  // ODE keeps pointers, not copies: the arrays live as long as the mesh data, which owns them
  // through its user pointer (see destroy_geom).
  TriangleMesh* const owned = mesh.release();
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
    image = read_heights(shape);
  } catch (const Error& error) {
    throw Error("collision '" + scoped_name + "': heightmap: " + error.what());
  }
  const std::vector<float>& heights = image.brightness;
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  data = dGeomHeightfieldDataCreate();
  dGeomHeightfieldDataBuildSingle(data, heights.data(), 1, shape.size.x(), shape.size.y(),
                                  image.columns, image.rows, 1.0, 0.0, kGroundThickness, 0);
  dGeomHeightfieldDataSetBounds(data, *lowest, *highest);
  return dCreateHeightfield(nullptr, data, 1);
}

/// ODE's heightfields stand on their x-z plane.
const Eigen::Quaterniond kUpright(std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0);

}  // namespace

bool must_be_static(const EngineGeom& geom) {
  const int kind = dGeomGetClass(geom.id);
  return kind == dPlaneClass || kind == dHeightfieldClass;
}

EngineGeom make_geom(const CollisionSpec& spec, const std::string& scoped_name, bool can_move) {
  EngineGeom geom;
  geom.name = scoped_name;
  geom.surface = spec.surface;
  if (can_move) geom.margin_m = contact_margin(spec.shape);
  struct Maker {
    EngineGeom& geom;
    dGeomID operator()(const BoxShape& s) const {
      const Eigen::Vector3d size = s.size.array() + 2.0 * geom.margin_m;
      return dCreateBox(nullptr, size.x(), size.y(), size.z());
    }
    dGeomID operator()(const SphereShape& s) const {
      return dCreateSphere(nullptr, s.radius + geom.margin_m);
    }
    dGeomID operator()(const CylinderShape& s) const {
      return dCreateCylinder(nullptr, s.radius + geom.margin_m, s.length + 2.0 * geom.margin_m);
    }
    dGeomID operator()(const CapsuleShape& s) const {
      return dCreateCapsule(nullptr, s.radius + geom.margin_m, s.length);
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

void destroy_geom(EngineGeom& geom) {
  if (geom.id == nullptr) return;
  auto* mesh = static_cast<TriangleMesh*>(geom.mesh != nullptr ? dGeomGetData(geom.id) : nullptr);
  dGeomDestroy(geom.id);
  if (geom.mesh != nullptr) dGeomTriMeshDataDestroy(geom.mesh);
  if (geom.heightfield != nullptr) dGeomHeightfieldDataDestroy(geom.heightfield);
  delete mesh;
  geom.id = nullptr;
  geom.mesh = nullptr;
  geom.heightfield = nullptr;
}

void place_static_geom(EngineGeom& geom, const SE3& T_world_shape) {
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

}  // namespace trident::sim
