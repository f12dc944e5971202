// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/costmap/costmap_params.h"
#include "trident_nav/costmap/distance_tracker.h"
#include "trident_nav/costmap/layer.h"
#include "trident_nav/costmap/layer_stack.h"

namespace trident::nav {

/// Layers, their master costs, and the exact distance from each cell to the nearest lethal one.
/// Not thread-safe: its owner locks it against its readers.
class Costmap {
 public:
  /// `layers` from the lowest to the highest. Throws Error when the parameters are not legal or two
  /// layers have one name.
  Costmap(CostmapParams params, std::vector<std::unique_ptr<Layer>> layers);

  const CostmapParams& params() const { return params_; }
  /// Takes other parameters from the next update on: the footprint, and the grid's size and place,
  /// by which cells that remain keep what layers know of them. Throws Error, and changes nothing.
  void set_params(const CostmapParams& params);
  const Footprint& footprint() const { return footprint_; }
  /// Replaces the footprint, as it is: without the padding of the parameters.
  void set_footprint(const Footprint& footprint);

  /// Moves the window, takes in what the layers have got, and computes what changed.
  void update(const CostmapInput& input);

  /// The costs and distances of the latest update; valid until the next call that is not const.
  CostGrid grid() const;
  /// Blocks whose master costs the latest update changed.
  const BlockSet& changed() const { return stack_.changed(); }
  /// True when the latest update gave the grid another size or another place.
  bool has_moved() const { return has_moved_; }

  /// nullptr when no layer has the name.
  Layer* layer(const std::string& name) const { return stack_.find(name); }
  const std::vector<std::unique_ptr<Layer>>& layers() const { return stack_.layers(); }

  /// Has layers forget what they sensed inside, or outside, of a square about a point: all layers,
  /// or those with the given names. The next update puts back what their sources see at the time,
  /// so that what vanishes is what is stale. Returns the names of the layers that were asked.
  std::vector<std::string> forget(const Point2& center, double side_m, Layer::Side side,
                                  const std::vector<std::string>& names = {});

  /// Sources that are too old to drive on.
  std::vector<StaleSource> stale_sources(double now_s) const;

 private:
  GridGeometry next_geometry(const Pose2& robot) const;
  void update_distances();
  void note_revision();
  double required_distance() const;

  CostmapParams params_;
  Footprint footprint_;
  LayerStack stack_;
  GridGeometry geometry_;
  DistanceTracker distances_;  // of the master costs, when no layer knows them
  bool is_tracking_ = false;   // distances_ is up to date
  bool has_moved_ = false;
  std::uint64_t revision_ = 0;
  std::vector<std::uint64_t> row_revisions_;
};

}  // namespace trident::nav
