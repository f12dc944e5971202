// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_nav/core/shape_cells.h"
#include "trident_nav/costmap/beam_source.h"
#include "trident_nav/costmap/layer.h"
#include "trident_nav/costmap/layer_factory.h"
#include "trident_nav/costmap/layer_grid.h"

namespace trident::nav {

/// How a layer's costs are put over those below. Unknown cells of the layer never replace any.
enum class Combination {
  kOverwrite = 0,
  kMaximum = 1,             ///< Unknown below is replaced.
  kNothing = 2,             ///< The layer leaves no costs.
  kMaximumKeepUnknown = 3,  ///< Unknown below stays so (Nav2's 2).
};

/// What obstacle and voxel layers have in common.
struct BeamLayerParams {
  bool enabled = true;
  bool footprint_clearing_enabled = true;
  double min_obstacle_height = -1e6;
  double max_obstacle_height = 2.0;
  int combination_method = 1;
  double transform_tolerance = 0.2;
  std::optional<bool> track_unknown_space;
  double decay_time = 0.0;
  std::map<std::string, BeamSourceParams> sources;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("enabled", enabled, "the layer leaves costs");
    ar.field("footprint_clearing_enabled", footprint_clearing_enabled,
             "cells under the robot are free");
    ar.field("min_obstacle_height", min_obstacle_height, "of what is marked [m]");
    ar.field("max_obstacle_height", max_obstacle_height, "of what is marked [m]");
    ar.field("combination_method", combination_method, Range{0, 3},
             "0 overwrite, 1 maximum, 2 nothing, 3 maximum, but unknown stays");
    ar.field("transform_tolerance", transform_tolerance, Range::non_negative(),
             "how long transforms are waited for [s]");
    ar.field("track_unknown_space", track_unknown_space,
             "cells begin as unknown; none: as the costmap's");
    ar.field("decay_time", decay_time, Range::non_negative(),
             "how long a mark lasts that is not seen again; 0: until it is cleared [s]");
    ar.field("sources", sources, "sources by their names");
  }
};

/// A layer that beams mark and clear. Each update, beams of new data clear first, then the ends of
/// all data in use are marked. A beam clears as far as its height is within that of obstacles,
/// wherever it ends; not the cell that it ends in, if that is an obstacle. What is seen beyond
/// obstacle_range does not mark, but it keeps the marks of its cell and the neighbors.
class BeamLayer : public CellLayer {
 public:
  /// Read at the start alone.
  static constexpr std::array kFixedKeys = {"track_unknown_space"};

  BeamLayer(const LayerSetup& setup, const BeamLayerParams& params);

  std::vector<BeamSource>& sources() { return sources_; }
  const std::vector<BeamSource>& sources() const { return sources_; }
  /// nullptr when no source has the name.
  BeamSource* find_source(const std::string& name);
  /// What may be changed while the costmap runs; `sources` and `track_unknown_space` are not.
  void set_beam_params(const BeamLayerParams& params);
  const BeamLayerParams& beam_params() const { return params_; }

  void set_footprint(const Footprint& footprint) override { footprint_ = footprint; }
  void resize(const GridGeometry& geometry) override;
  void update(const CostmapInput& input, BlockSet& changed) override;
  void combine(int y, int x0, int x1, std::uint8_t* cost) const override;
  void forget(const CellBox& box, Side side) override;
  std::vector<StaleSource> stale_sources(double now_s) const override;

 protected:
  /// Where a source's beams mark and clear.
  struct Reach {
    double low_m, high_m;             ///< Heights of obstacles in the costmap's frame.
    double clear_from_m, clear_to_m;  ///< Distances from the sensor along the ground.
    double mark_from_m, mark_to_m;    ///< Distances from the sensor.
    bool is_marking;
  };

  virtual void clear_beams(const Observation& observation, const Reach& reach) = 0;
  virtual void mark_ends(const Observation& observation, const Reach& reach, double now_s) = 0;
  /// Notes what else than its cost a cell has whose mark is kept, and restores it: `index` counts
  /// the kept cells of an update.
  virtual void keep_cell(std::size_t /*cell*/) {}
  virtual void restore_cell(std::size_t cell, std::size_t /*index*/, double now_s) {
    mark(cell, now_s);
  }
  /// Forgets, or knows to be free, what is kept of cells besides their costs.
  virtual void forget_cells(int /*y*/, int /*x0*/, int /*x1*/) {}
  virtual void free_cells(int /*y*/, int /*x0*/, int /*x1*/) {}

  const GridGeometry& geometry() const { return costs_.geometry(); }
  std::uint8_t* costs() { return costs_.cells().data(); }
  std::uint8_t unmarked() const { return costs_.fill(); }
  void set_cost(std::size_t cell, std::uint8_t cost) {
    std::uint8_t& old = costs_.cells()[cell];
    if (old == cost) return;
    old = cost;
    const auto width = static_cast<std::size_t>(geometry().width);
    changed_.insert(static_cast<int>(cell % width), static_cast<int>(cell / width));
  }
  /// Marks a cell, at a time [s].
  void mark(std::size_t cell, double now_s) {
    set_cost(cell, kLethalCost);
    if (!mark_times_s_.cells().empty()) mark_times_s_.cells()[cell] = now_s;
  }

 private:
  Reach reach_of(const BeamSourceParams& source) const;
  bool has_news(const Pose2& robot) const;
  void apply_data(double now_s);
  /// Calls visit(source, stored) for all data in use.
  template <class Visit>
  void for_each_stored(Visit&& visit) {
    for (const BeamSource& source : sources_) {
      for (const BeamSource::Stored& stored : source.stored()) visit(source, stored);
    }
  }
  void find_kept_marks();
  void find_kept_marks(const Observation& observation, const Reach& reach);
  void clear_fresh_beams();
  void mark_all_ends(double now_s);
  void keep_around(const Point2& p);
  void clear_footprint(const Pose2& robot);
  void set_row(int y, int x0, int x1, std::uint8_t cost);
  void decay(double now_s);
  void decay_row(int y, double now_s);

  BeamLayerParams params_;
  std::vector<BeamSource> sources_;
  Footprint footprint_;
  LayerGrid<std::uint8_t> costs_;
  LayerGrid<double> mark_times_s_;  // of the latest mark; empty when marks do not decay
  BlockSet changed_;                // since the last update
  std::vector<std::size_t> kept_;   // cells whose marks are seen from beyond obstacle_range
  ShapeCells shape_;
  std::optional<Pose2> last_robot_;
  bool is_all_fresh_ = false;  // data in use are to be applied again
  int next_decay_row_ = 0;
};

}  // namespace trident::nav
