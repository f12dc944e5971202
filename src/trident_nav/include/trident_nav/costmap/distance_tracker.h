// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/costmap/block_set.h"

namespace trident::nav {

/// Cells [x0, x1) of row y with their squared distances [cells^2] to the nearest seed.
struct DistanceSpan {
  int y = 0;
  int x0 = 0;
  int x1 = 0;
  /// Of cell x at [x - x0], DistanceTracker::beyond() where no seed is near; nullptr: all are.
  const std::uint16_t* square = nullptr;
};

/// Gets the distances of each run of cells that an update looked at.
class DistanceSink {
 public:
  DistanceSink() = default;
  DistanceSink(const DistanceSink&) = delete;
  DistanceSink& operator=(const DistanceSink&) = delete;
  virtual ~DistanceSink() = default;
  virtual void take(const DistanceSpan& span) = 0;
};

/// The exact Euclidean distance from each cell's center to that of the nearest seed (a lethal cell,
/// by choice also an unknown one) up to a cut, kept up as seeds come and go.
///
/// Each cell keeps how many rows away the nearest seed of its own column is (the first pass of
/// Saito and Toriwaki 1994). A seed that comes or goes changes this in its own column alone, at
/// most `reach` cells up and down; then only the runs of rows within `reach` columns of such a
/// change get new distances, min over dx of dx^2 + rows(x + dx)^2. So an update costs as much as
/// what changed, and is exact: whole numbers throughout, equal to a computation from nothing.
class DistanceTracker {
 public:
  enum class Seeds { kLethal, kLethalOrUnknown };

  /// The most cells that a distance can reach.
  static constexpr int kMaxReach = 254;

  /// Distances beyond `max_distance_m` all count as that. A cut of more than kMaxReach cells is
  /// taken as that many.
  explicit DistanceTracker(double max_distance_m, Seeds seeds = Seeds::kLethal);

  /// Changes the cut; the next update must be of all cells.
  void set_max_distance(double max_distance_m);
  /// Takes a grid's size; the next update must be of all cells.
  void resize(const GridGeometry& geometry);

  /// Takes in the blocks of `cost` (one byte a cell, rows without gaps) that changed, and hands
  /// `sink` every run of cells whose cost or distance may have changed.
  void update(const std::uint8_t* cost, const BlockSet& changed, DistanceSink& sink);

  /// Distances [m], rows without gaps, cut at max_distance_m().
  const float* distance_m() const { return distance_m_.data(); }
  float max_distance_m() const { return max_distance_m_; }
  Seeds seeds() const { return seeds_; }
  /// The squared distance that stands for all beyond the cut [cells^2]; squares below it are exact.
  int beyond() const { return beyond_; }

 private:
  bool is_seed(std::uint8_t cost) const {
    return cost == kLethalCost || (cost == kUnknownCost && seeds_ == Seeds::kLethalOrUnknown);
  }
  void fill_tables();
  bool collect_toggles(const std::uint8_t* cost, const BlockSet& changed);
  void collect_span(const std::uint8_t* cost, int y, int x0, int x1);
  void rebuild_columns(const std::uint8_t* cost);
  void add_seed(int x, int y);
  void remove_seed(int x, int y);
  int rows_to_seed(int x, int y, int step) const;
  void set_rows(int x, int y, int rows);
  void refresh_span(int y, int x0, int x1, DistanceSink& sink);
  void find_near_blocks(int y, int first, int end);
  void refresh_near(int y, int x0, int x1, DistanceSink& sink);
  void refresh_beyond(int y, int x0, int x1, DistanceSink& sink);

  Seeds seeds_;
  double wanted_distance_m_;
  float max_distance_m_ = 0.0F;
  GridGeometry geometry_;
  int reach_ = 0;                   // columns and rows that a distance reaches
  int beyond_ = 1;                  // squared distance of what is farther
  std::vector<std::uint8_t> rows_;  // to the nearest seed of the column, reach_ + 1: none is near
  std::vector<float> distance_m_;
  std::vector<float> table_m_;  // by squared distance
  BlockSet near_;               // blocks of which distance_m_ is not all max_distance_m_
  BlockSet stale_;              // blocks whose distances may have changed
  std::vector<Cell> toggles_;   // cells that became seeds or ceased to be
  std::vector<std::uint16_t> squares_, result_;  // of one run
  std::vector<std::uint8_t> is_near_;            // by block of a row
};

}  // namespace trident::nav
