// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/physics/height_image.h"
#include "mesh.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

/// So many samples become triangles that need about 0.8 GB; ODE, which needs none, takes more.
constexpr std::size_t kMaxSamples = std::size_t{2049} * 2049;

}  // namespace

namespace {

/// Two triangles for each square of samples, whose rows follow each other.
std::vector<std::uint32_t> triangles_between(std::uint32_t columns, std::uint32_t rows) {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t{6} * (columns - 1) * (rows - 1));
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column, b = a + 1, c = a + columns, d = c + 1;
      indices.insert(indices.end(), {a, c, b, d, b, c});
    }
  }
  return indices;
}

}  // namespace

TriangleMesh read_heightmap(const HeightmapShape& shape, MeshDetail detail) {
  const HeightImage image = read_heights(shape);
  if (image.brightness.size() > kMaxSamples) {
    throw Error("heightmap '" + shape.file + "' has " + std::to_string(image.columns) + " x " +
                std::to_string(image.rows) + " samples, rays can be cast at up to " +
                std::to_string(kMaxSamples));
  }
  const auto columns = static_cast<std::uint32_t>(image.columns);
  const auto rows = static_cast<std::uint32_t>(image.rows);
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * image.brightness.size());
  for (std::uint32_t row = 0; row < rows; ++row) {
    const double down = static_cast<double>(row) / (rows - 1);
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double right = static_cast<double>(column) / (columns - 1);
      mesh.vertices.push_back(static_cast<float>((right - 0.5) * shape.size.x()));
      mesh.vertices.push_back(static_cast<float>((0.5 - down) * shape.size.y()));
      mesh.vertices.push_back(image.brightness[std::size_t{row} * columns + column]);
      if (detail == MeshDetail::kShape) continue;
      mesh.uvs.push_back(static_cast<float>(right));
      mesh.uvs.push_back(static_cast<float>(1.0 - down));
    }
  }
  mesh.indices = triangles_between(columns, rows);
  return mesh;
}

}  // namespace trident::sim
