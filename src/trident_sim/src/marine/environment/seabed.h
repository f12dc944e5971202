// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident::sim {

enum class BathymetryKind { kNone, kFile, kTerrain };
constexpr auto enum_names(BathymetryKind) {
  return std::array{EnumName{BathymetryKind::kNone, "none"},
                    EnumName{BathymetryKind::kFile, "file"},
                    EnumName{BathymetryKind::kTerrain, "terrain"}};
}
enum class VerticalSense { kUp, kDown };
constexpr auto enum_names(VerticalSense) {
  return std::array{EnumName{VerticalSense::kUp, "up"}, EnumName{VerticalSense::kDown, "down"}};
}

/// Where the ground below the water is known from.
struct BathymetryParams {
  BathymetryKind kind = BathymetryKind::kNone;
  std::string file;
  VerticalSense positive = VerticalSense::kUp;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::string model;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("kind", kind, "file: a raster; terrain: the world's heightmaps");
    ar.field("file", file, "ESRI ASCII grid, its corner and cell in metres of the world");
    ar.field("positive", positive, "of the file: up: heights of the ground; down: depths");
    ar.field("offset", offset, "from the file's origin and datum to the world's [m]");
    ar.field("model", model,
             "terrain: the one model whose heightmaps count; empty: all that stand");
  }
  /// Throws Error: kind file without a file.
  void validate() const;
};

/// Heights of the ground on a regular grid, linear in between, that may be turned about z.
struct GroundGrid {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< world, of the first point [m]
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit vector of rising columns, world
  Eigen::Vector2d cell = Eigen::Vector2d::Ones();    ///< between points, > 0 [m]
  int columns = 0, rows = 0;                         ///< >= 2
  std::vector<float> z_m;                            ///< (columns rows), columns run fastest

  /// In cells from the first point.
  Eigen::Vector2d place(const Eigen::Vector2d& p_world) const {
    const Eigen::Vector2d d = p_world - origin;
    return {(d.x() * along.x() + d.y() * along.y()) / cell.x(),
            (d.y() * along.x() - d.x() * along.y()) / cell.y()};
  }
  bool contains(const Eigen::Vector2d& place) const {
    return place.x() >= 0.0 && place.y() >= 0.0 && place.x() <= columns - 1 &&
           place.y() <= rows - 1;
  }
  /// Beyond its edge as at the nearest point of it.
  double height_m(const Eigen::Vector2d& place) const;
};

/// The ground of a sea. Where grids overlap the highest counts.
class Seabed {
 public:
  explicit Seabed(std::vector<GroundGrid> grids);

  /// z of the ground; outside of all grids that at the nearest one's edge.
  double height_m(const Eigen::Vector2d& p_world) const;
  /// Below z = 0; negative on land.
  double depth_m(const Eigen::Vector2d& p_world) const { return -height_m(p_world); }
  /// The same; `enough` or more where the ground about the place is known to lie that deep.
  double depth_m(const Eigen::Vector2d& p_world, double enough) const;
  /// Mean over the points that lie below `level_m`, of their depth below it; 0 without any.
  double mean_depth_m(double level_m) const;

 private:
  std::vector<GroundGrid> grids_;
  /// Of the first grid, the greatest height in each square of so many cells.
  static constexpr int kBlock = 8;
  int block_columns_ = 0;
  std::vector<float> block_highest_m_;
};

/// Reads an ESRI ASCII grid (ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter,
/// cellsize, NODATA_value). Throws Error naming file, line and what is legal; cells without data
/// are not.
GroundGrid read_ascii_grid(const BathymetryParams& params);

/// Smoothstep: 0 for depths <= 0, 1 from `full_m` on.
inline double shore_fade(double depth_m, double full_m) {
  const double part = std::clamp(depth_m / full_m, 0.0, 1.0);
  return part * part * (3.0 - 2.0 * part);
}

}  // namespace trident::sim
