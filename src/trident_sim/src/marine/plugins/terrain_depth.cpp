// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "terrain_depth.h"

#include <algorithm>
#include <variant>

#include "core/physics/height_image.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

GroundGrid grid_of(const HeightmapShape& shape, const SE3& T_world_shape, const std::string& name) {
  if ((T_world_shape.R * Eigen::Vector3d::UnitZ()).z() < 1.0 - 1e-9) {
    throw Error("<bathymetry> <kind> is 'terrain', expected level heightmaps; that of collision '" +
                name + "' is tilted");
  }
  const HeightImage image = read_heights(shape);
  GroundGrid grid;
  grid.columns = image.columns;
  grid.rows = image.rows;
  // Pixels are the corners of cells: there is one cell less than pixels.
  grid.cell = {shape.size.x() / (image.columns - 1), shape.size.y() / (image.rows - 1)};
  grid.origin = (T_world_shape * Eigen::Vector3d(-0.5 * shape.size.x(), -0.5 * shape.size.y(), 0.0))
                    .head<2>();
  grid.along = (T_world_shape.R * Eigen::Vector3d::UnitX()).head<2>().normalized();
  grid.z_m.reserve(image.brightness.size());
  const auto width = static_cast<std::ptrdiff_t>(image.columns);
  for (std::ptrdiff_t row = image.rows - 1; row >= 0; --row) {  // the picture's top lies at +y
    const auto first = image.brightness.begin() + row * width;
    grid.z_m.insert(grid.z_m.end(), first, first + width);
  }
  for (float& z : grid.z_m) z += static_cast<float>(T_world_shape.p.z());
  return grid;
}

void add_heightmaps(const Model& model, std::vector<GroundGrid>* grids) {
  for (const LinkSpec& link : model.spec.links) {
    for (const CollisionSpec& collision : link.collisions) {
      const auto* const shape = std::get_if<HeightmapShape>(&collision.shape);
      if (shape == nullptr) continue;
      const SE3 T = model.T_world_model_initial * link.T_model_link * collision.T_link_shape;
      grids->push_back(grid_of(*shape, T, model.name + "::" + link.name + "::" + collision.name));
    }
  }
}

/// Of the static models, or of the one named `wanted`.
std::vector<GroundGrid> terrain_grids(const World& world, const std::string& wanted) {
  std::vector<GroundGrid> grids;
  for (const auto& [name, model] : world.models()) {
    if (!model->is_static || (!wanted.empty() && name != wanted)) continue;
    add_heightmaps(*model, &grids);
  }
  return grids;
}

}  // namespace

std::shared_ptr<const Seabed> make_seabed(const BathymetryParams& params, const World& world) {
  if (params.kind == BathymetryKind::kNone) return nullptr;
  if (params.kind == BathymetryKind::kFile) {
    return std::make_shared<const Seabed>(std::vector<GroundGrid>{read_ascii_grid(params)});
  }
  std::vector<GroundGrid> grids = terrain_grids(world, params.model);
  if (grids.empty()) {
    throw Error("<bathymetry> <kind> is 'terrain', expected a static model" +
                (params.model.empty() ? "" : " '" + params.model + "'") +
                " with the collision of a heightmap in the world's file");
  }
  return std::make_shared<const Seabed>(std::move(grids));
}

}  // namespace trident::sim
