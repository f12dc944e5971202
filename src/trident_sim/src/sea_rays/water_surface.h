// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "rays/analytic_surface.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/sea.h"
#include "water_tiles.h"

namespace trident::sim {

/// Where a ray hits the water.
struct WaterHit {
  double t = std::numeric_limits<double>::infinity();  ///< along the ray; infinite: nowhere
  bool begins_below = false;                           ///< the ray begins under water
  bool is_far =
      false;  ///< on the plane beyond WaterSurface::far_m(), whose slope was not asked for
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< else that of the surface there
};

/// Distances between which a ray from above hits the water for certain, if it gets there.
struct WaterReach {
  double first, last;
};

/// The surface of a world's sea as rays hit it: heights of a periodic tile about who looks,
/// between which they are bilinear; farther away than far_m() the still level, with the slopes of
/// the tile. Nothing is worked out before follow() is called, and one tile per period of the waves
/// after that (WaterPattern says how true it is). What is hit is a pure function of the sea, the
/// time and the place that was given to follow(). Any number of threads may ask at the same time.
class WaterSurface final : public AnalyticSurface {
 public:
  /// With tiles of its own. `world` must outlive it.
  explicit WaterSurface(const World& world) : WaterSurface(std::make_shared<WaterTiles>(world)) {}
  explicit WaterSurface(std::shared_ptr<WaterTiles> tiles) : tiles_(std::move(tiles)) {}

  /// Takes the water as it is now about a place, which stays until it is called again. False: the
  /// world has no sea.
  bool follow(const Eigen::Vector3d& p_world_viewer);

  AnalyticHit intersect(const Ray& ray, double t_max) const override;
  /// The same with what a picture of the water needs.
  WaterHit find_hit(const Ray& ray, double t_max) const;
  // Of a ray that begins above all waves, with a direction of unit length, without following it.

  /// Infinite: it leads away.
  WaterReach reach(const Ray& ray) const;
  /// No steeper does it hit the water: the cosine to the surface's normal. The first is of any
  /// water, the second costs more, is of this reach and no greater.
  double cos_most(const Ray& ray) const { return cos_most(ray, steepest_.fading); }
  double cos_most(const Ray& ray, const WaterReach& reach) const {
    return cos_most(ray, is_open_between(ray, reach) ? steepest_.open : steepest_.fading);
  }
  double height_m(const Eigen::Vector2d& p_world) const;
  /// d height / d place.
  Eigen::Vector2d slope(const Eigen::Vector2d& p_world) const;
  /// No water is higher.
  double highest_m() const { return level_m_ + high_m_; }
  /// Horizontal distance from a ray's origin beyond which the surface counts as a plane.
  double far_m() const { return far_m_; }
  /// Normal at a place, of unit length, upward.
  Eigen::Vector3d normal(const Eigen::Vector2d& p_world) const;

  // What pictures are made with.

  /// nullptr: the water is flat.
  const WaterTile* tile() const { return tile_.get(); }
  const WaterPattern& pattern() const { return *pattern_; }
  /// Share of the tile's second end in the heights.
  float weight() const { return weight_; }
  /// Factor of the tile's heights at a place.
  double strength(const Eigen::Vector2d& p_world) const;

 private:
  /// A ray in units of cells along the tile's axes, and metres above the still level.
  struct Path {
    double u, v, z, du, dv, dz;
    double per_du, per_dv;
    double side;  ///< 1: comes from above, -1: from below
    bool fades;   ///< the water's strength changes along it
  };
  /// h + h_u p + h_v q + h_uv p q within a cell, p and q in [0, 1] [m].
  struct Patch {
    double h, h_u, h_v, h_uv;
  };
  /// No slope is steeper.
  struct Steepest {
    double open = 0.0;    ///< away from the shore
    double fading = 0.0;  ///< anywhere
  };
  /// What a ray hits first, square by square.
  struct Found {
    double t = std::numeric_limits<double>::infinity();
    double along = 0.0, across = 0.0;  ///< slope per cell there
    bool is_hit() const { return t < std::numeric_limits<double>::infinity(); }
  };
  void find_tile(const Eigen::Vector2d& p_world_viewer);
  /// Heights of the tile there, of rows and columns 00, 10, 01, 11.
  std::array<double, 4> corners_of(std::int64_t row, std::int64_t column) const {
    return {static_cast<double>(tile_->height(row, column, weight_)),
            static_cast<double>(tile_->height(row + 1, column, weight_)),
            static_cast<double>(tile_->height(row, column + 1, weight_)),
            static_cast<double>(tile_->height(row + 1, column + 1, weight_))};
  }
  Patch even(const std::array<double, 4>& corners) const {
    const auto [h00, h10, h01, h11] = corners;
    const double s = strength_;
    return {s * h00, s * (h10 - h00), s * (h01 - h00), s * ((h00 - h10) - (h01 - h11))};
  }
  Patch faded(std::array<double, 4> corners, std::int64_t row, std::int64_t column) const;
  Patch patch_at(std::int64_t row, std::int64_t column) const {
    const std::array<double, 4> corners = corners_of(row, column);
    return shore(row, column) == WaveField::Shore::kOpen ? even(corners)
                                                         : faded(corners, row, column);
  }
  Path path_of(const Ray& ray) const;
  /// What holds all over the square of WaterShores::kCells cells that a cell lies in.
  WaveField::Shore shore(std::int64_t row, std::int64_t column) const {
    return fades_ ? shores_->at(row, column) : WaveField::Shore::kOpen;
  }
  static double cos_most(const Ray& ray, double steepest);
  bool is_open_between(const Ray& ray, const WaterReach& reach) const;
  double cell_height(double u, double v) const;
  template <std::size_t kLevel>
  Found walk(const Path& path, double t0, double t1) const;
  template <std::size_t kLevel>
  Found intersect_square(const Path& path, std::int64_t row, std::int64_t column, double t0,
                         double t1) const;
  bool may_hit(const Path& path, std::size_t level, std::int64_t row, std::int64_t column,
               double t0, double t1) const;
  static Found intersect_level(const Path& path, double t0, double t1);
  Found intersect_cell(const Path& path, std::int64_t row, std::int64_t column, double t0,
                       double t1) const;
  bool stays_clear(const Path& path, const std::array<double, 4>& corners, double t0,
                   double t1) const;

  std::shared_ptr<WaterTiles> tiles_;
  std::shared_ptr<const Sea> sea_;
  const WaveField* waves_ = nullptr;             ///< of sea_; nullptr: flat
  std::shared_ptr<const WaterPattern> pattern_;  ///< of the tile
  std::shared_ptr<const WaterTile> tile_;        ///< nullptr: flat
  std::shared_ptr<const WaterShores> shores_;    ///< where waves fade

  double time_s_ = 0.0, level_m_ = 0.0;
  float weight_ = 0.0F;
  bool fades_ = false;                               ///< strength depends on the place
  double strength_ = 1.0;                            ///< away from the shore
  double low_m_ = 0.0, high_m_ = 0.0, far_m_ = 0.0;  ///< heights are about the still level
  Steepest steepest_;
};

/// The water that a scene's analytic surface is; nullptr: it is not water.
const WaterSurface* as_water(const AnalyticSurface* surface);
std::shared_ptr<const WaterSurface> as_water(const std::shared_ptr<const AnalyticSurface>& surface);

}  // namespace trident::sim
