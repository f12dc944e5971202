// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "trident_sim/port.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/sea.h"
#include "water_tile.h"

namespace trident {

/// Where a ray meets the water.
struct WaterMeeting {
  double t = std::numeric_limits<double>::infinity();  ///< along the ray; infinite: nowhere
  bool begins_below = false;                           ///< the ray begins under water
};

/// The surface of a world's sea as rays meet it: heights of a periodic tile about who looks,
/// between which they are bilinear; farther away than far_m() the still level, with the slopes of
/// the tile. Nothing is worked out before follow() is called, and one tile per period of the waves
/// after that (WaterPattern says how true it is). What is met is a pure function of the sea, the
/// time and the place that was given to follow().
class WaterSurface {
 public:
  /// `world` must outlive it.
  explicit WaterSurface(const World& world) : world_(world) {}

  /// No water is higher now, wherever it is [m]; minus infinity: the world has no sea. follow() may
  /// be left out where no ray goes below.
  double ceiling_m();
  /// Takes the water as it is now about a place. False: the world has no sea.
  bool follow(const Eigen::Vector3d& p_world_viewer);

  /// The first meeting between t_min_m and t_max. Directions may have any length.
  WaterMeeting meet(const Ray& ray, double t_max) const;
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
  const WaterPattern& pattern() const { return maker_->pattern(); }
  /// Share of the tile's second end in the heights.
  float weight() const { return weight_; }
  /// Factor of the tile's heights at a place.
  double strength(const Eigen::Vector2d& p_world) const;
  /// How many tiles were made.
  std::uint64_t tiles_made() const { return tiles_made_; }

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
  /// What the ground does to the waves in squares of cells about an anchor. A pure function of the
  /// anchor and of the water's level in steps.
  struct Shores {
    std::int64_t anchor_row, anchor_column, level;
    std::int64_t first_row, first_column;  ///< of squares
    std::vector<WaveField::Shore> squares;
  };
  static constexpr std::int64_t kShoreCells = WaterTile::kBoundSides[1], kShoreSide = 64;
  bool find_sea();
  void follow_waves(const WaveField& waves);
  void find_tile(const Eigen::Vector2d& p_world_viewer);
  Patch patch(std::int64_t row, std::int64_t column, bool fades) const {
    const auto h00 = static_cast<double>(tile_->height(row, column, weight_));
    const auto h10 = static_cast<double>(tile_->height(row + 1, column, weight_));
    const auto h01 = static_cast<double>(tile_->height(row, column + 1, weight_));
    const auto h11 = static_cast<double>(tile_->height(row + 1, column + 1, weight_));
    if (fades) return faded({h00, h10, h01, h11}, row, column);
    const double s = strength_;
    return {s * h00, s * (h10 - h00), s * (h01 - h00), s * ((h00 - h10) - (h01 - h11))};
  }
  Patch faded(std::array<double, 4> corners, std::int64_t row, std::int64_t column) const;
  Patch patch_at(std::int64_t row, std::int64_t column) const {
    return patch(row, column, shore(row, column) != WaveField::Shore::kOpen);
  }
  Path path_of(const Ray& ray) const;
  void find_shores();
  /// What holds all over the square of kShoreCells cells that a cell lies in.
  WaveField::Shore shore(std::int64_t row, std::int64_t column) const;
  static double meet_level(const Path& path, double t0, double t1);
  double cell_height(double u, double v) const;
  double walk(const Path& path, int level, double t0, double t1) const;
  bool may_meet(const Path& path, int level, std::int64_t row, std::int64_t column, double t0,
                double t1) const;
  double meet_cell(const Path& path, std::int64_t row, std::int64_t column, double t0,
                   double t1) const;

  const World& world_;
  std::optional<std::uint64_t> seen_ports_;  ///< PortBoard::version()
  const OutPort<SeaSample>* port_ = nullptr;
  std::shared_ptr<const Sea> sea_;
  const WaveField* waves_ = nullptr;       ///< of sea_; nullptr: flat
  double amplitudes_m_ = 0.0;              ///< sum of those of
  std::vector<WaveComponent> seen_waves_;  ///< those that the tiles are of, and
  WaveParams seen_params_;                 ///< what made them
  std::unique_ptr<WaterTileMaker> maker_;
  std::vector<std::shared_ptr<WaterTile>> tiles_;  ///< the newest last
  std::shared_ptr<const WaterTile> tile_;          ///< now; nullptr: flat
  std::vector<Shores> shores_;                     ///< the newest last: now
  std::uint64_t tiles_made_ = 0;

  double time_s_ = 0.0, level_m_ = 0.0;
  float weight_ = 0.0F;
  bool fades_ = false;                               ///< strength depends on the place
  double strength_ = 1.0;                            ///< away from the shore
  double low_m_ = 0.0, high_m_ = 0.0, far_m_ = 0.0;  ///< heights are about the still level
};

}  // namespace trident
