// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "trident_base/worker_pool.h"
#include "trident_sim/port.h"
#include "trident_sim/sea.h"
#include "water_tile.h"

namespace trident::sim {

/// std::floor is a call where the processor is not known.
inline std::int64_t floor_of(double value) {
  const auto cut = static_cast<std::int64_t>(value);
  return cut - (value < static_cast<double>(cut) ? 1 : 0);
}

/// What the ground does to the waves in squares of cells about an anchor. A pure function of the
/// anchor and of the water's level in steps.
struct WaterShores {
  static constexpr std::int64_t kCells = WaterTile::kBoundSides[1], kSide = 64;
  std::int64_t anchor_row, anchor_column, level;
  std::int64_t first_row, first_column;  ///< of squares
  std::vector<WaveField::Shore> squares;

  /// Of the square that a cell lies in.
  WaveField::Shore at(std::int64_t row, std::int64_t column) const {
    constexpr int kShift = 5;
    static_assert(std::int64_t{1} << kShift == kCells, "as >> has it");
    return of_square(row >> kShift, column >> kShift);
  }
  WaveField::Shore of_square(std::int64_t row, std::int64_t column) const {
    const std::int64_t i = row - first_row, j = column - first_column;
    if (i < 0 || j < 0 || i >= kSide || j >= kSide) return WaveField::Shore::kFading;
    return squares[static_cast<std::size_t>(i * kSide + j)];
  }
};

/// The waves of a world's sea laid onto tiles, for all that look at it: each tile is made once,
/// for the first that asks, and one per period of the waves after that. Only one thread may ask;
/// what it is given stays as it is.
class WaterTiles {
 public:
  /// `world` must outlive it.
  explicit WaterTiles(const World& world) : world_(world) {}
  const World& world() const { return world_; }

  /// As it is now; nullptr: the world has none.
  std::shared_ptr<const Sea> find_sea();
  /// Lays the waves again if others are given than the last time.
  void follow(const WaveField& waves);

  /// Makes the tiles about these places that are not there yet, side by side.
  void prepare(const std::vector<Eigen::Vector2d>& places, WorkerPool& workers);

  // Of the waves that were given last.

  /// nullptr: no waves.
  const std::shared_ptr<const WaterPattern>& pattern() const { return pattern_; }
  /// Sum of their amplitudes.
  double amplitudes_m() const { return amplitudes_m_; }
  /// About a place; there are waves.
  std::shared_ptr<const WaterTile> tile(const Eigen::Vector2d& p_world, double time_s);
  /// About a tile's anchor, of waves that fade, at a still level.
  std::shared_ptr<const WaterShores> shores(const WaveField& waves, const WaterTile::Key& key,
                                            double level_m);
  /// How many tiles were made.
  std::uint64_t tiles_made() const { return tiles_made_; }

 private:
  std::shared_ptr<WaterTile> take_room(std::int64_t period);
  WaterTile::Key key_near(const Eigen::Vector2d& p_world, double time_s) const;
  bool knows(const WaterTile::Key& key) const;
  WaterTileMaker& maker(std::size_t worker);
  bool has_laid(const WaveField& waves) const;
  void begin_missing(const std::vector<Eigen::Vector2d>& places, double time_s);
  WaterShores make_shores(const WaveField& waves, const WaterTile::Key& key, std::int64_t level,
                          std::array<double, 2> levels_m) const;

  const World& world_;
  std::optional<std::uint64_t> seen_ports_;  ///< PortBoard::version()
  const OutPort<SeaSample>* port_ = nullptr;
  std::vector<WaveComponent> seen_waves_;  ///< those that the tiles are of, and
  WaveParams seen_params_;                 ///< what made them
  double amplitudes_m_ = 0.0;
  std::shared_ptr<const WaterPattern> pattern_;
  std::vector<std::unique_ptr<WaterTileMaker>> makers_;  ///< by worker; nullptr: not needed yet
  std::vector<WaterTile*> missing_;
  std::vector<std::shared_ptr<WaterTile>> tiles_;  ///< the one that was asked for last is the last
  std::vector<std::shared_ptr<const WaterShores>> shores_;  ///< as above
  std::uint64_t tiles_made_ = 0;
};

}  // namespace trident::sim
