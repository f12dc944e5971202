// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "trident_sim/model_spec.h"

namespace trident::sim {

/// Triangles in the frame of their shape, scaled.
struct TriangleMesh {
  std::vector<float> vertices;         ///< x y z [m]
  std::vector<std::uint32_t> indices;  ///< three a triangle

  // What follows is for looking at, and empty where only the shape was asked for.
  std::vector<float> normals;  ///< x y z per vertex, of unit length or zero: unknown; or empty
  std::vector<float> uvs;      ///< u v per vertex, v upwards; or empty
  std::vector<std::uint32_t> triangle_materials;  ///< index into `materials` per triangle; or empty
  std::vector<Material> materials;

  std::size_t vertex_count() const { return vertices.size() / 3; }
  std::size_t triangle_count() const { return indices.size() / 3; }
};

enum class MeshDetail { kShape, kLook };

/// Reads what assimp can read. As in Gazebo and rviz the `<up_axis>` of a COLLADA file does not
/// turn it. Throws Error, which names the file, when it cannot be read or has no triangles.
TriangleMesh read_mesh(const MeshShape& shape, MeshDetail detail);

/// The mesh of a shape that PreparedMeshes has read, once for each that it has read; or nothing.
std::optional<TriangleMesh> take_prepared_mesh(const MeshShape& shape);

/// The surface of a heightmap, centred on its origin in x and y, the top of the picture at +y: two
/// triangles between four samples, parted from +x +y to -x -y as ODE does it. Texture coordinates
/// in [0, 1] over the whole. Throws Error with the file's name, also for more than 2049 x 2049
/// samples.
TriangleMesh read_heightmap(const HeightmapShape& shape, MeshDetail detail);

}  // namespace trident::sim
