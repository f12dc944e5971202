// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"
#include "trident_maps/distance_field.h"

namespace trident::maps {

/// A place where a scan could have been taken.
struct PoseHypothesis {
  SE2 T_map_base;          ///< refined, on a free cell
  double score = 0.0;      ///< mean likelihood of the beams' ends, 0 ... 1
  double agreement = 0.0;  ///< scan_agreement() there
};

/// Resolution of the search, and which of its results are returned.
struct GridMatcherParams {
  double cell = 0.1;                  ///< of the search; at least the map's own [m]
  double sigma = 0.15;                ///< of a beam's end about the map [m]
  int depth = 5;                      ///< levels; the first steps are 2^depth cells wide
  int max_hypotheses = 8;             ///< that are returned
  double keep_ratio = 0.8;            ///< none whose score is below this share of the best
  double distinct_m = 0.7;            ///< hypotheses nearer than that ...
  double distinct_rad = 0.35;         ///< ... and turned less than that are the same
  std::size_t max_nodes = 2'000'000;  ///< looked at; beyond it, what was found so far is all
};

/// Looks for a scan in a whole map, without a guess: branch and bound over all translations and
/// rotations, with upper bounds from a pyramid of maxima of the map's likelihood (Hess, Kohler,
/// Rapp, Andor, "Real-time loop closure in 2D lidar SLAM", ICRA 2016). Best-first, so that the best
/// pose on the search's lattice is the first that is found, and distinct others follow in order.
class GridMatcher {
 public:
  /// Builds the pyramid; `grid` is not kept.
  explicit GridMatcher(const OccupancyGrid& grid, const GridMatcherParams& params = {});

  /// Poses on free cells, refined, those that agree best first; empty without points. `points` are
  /// used as they are: 60 to 150 of a scan are enough.
  std::vector<PoseHypothesis> match(const ScanPoints& points) const;

  /// The likelihood of a pose in the map, as `PoseHypothesis::score`.
  double score(const ScanPoints& points, const SE2& T_map_base) const;

 private:
  struct Node;
  struct Rotation;
  struct Level {
    std::vector<std::uint8_t> likelihood;  ///< maximum over 2^level x 2^level cells from here on
    std::vector<std::uint8_t> is_free;     ///< whether any of those is free
  };

  void build_levels(const OccupancyGrid& grid);
  Level coarser(const Level& finer, int step) const;
  std::vector<Rotation> rotations(const ScanPoints& points) const;
  int bound(const Rotation& rotation, int level, int column, int row) const;
  bool may_be_free(int level, int column, int row) const;
  std::vector<Node> first_nodes(const std::vector<Rotation>& rotations) const;
  std::vector<Node> search(const std::vector<Rotation>& rotations) const;
  SE2 pose_of(const Rotation& rotation, const Node& node) const;
  bool is_distinct(const Rotation& rotation, const Node& node, const std::vector<Node>& found,
                   const std::vector<Rotation>& rotations) const;
  double score_in_grid(const ScanPoints& points, const SE2& T_grid_base) const;
  SE2 refined(const ScanPoints& points, SE2 T_grid_base) const;

  GridMatcherParams params_;
  SE2 T_map_origin_;
  DistanceField field_;
  double cell_;         ///< [m]
  int columns_, rows_;  ///< of the search's grid
  int pad_;             ///< cells before column and row 0 in `Level`
  int stride_;
  std::vector<Level> levels_;
};

}  // namespace trident::maps
