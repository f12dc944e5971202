// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// What a costmap is stacked from. A new layer is a folder with a header and a source that ends
/// with TRIDENT_COSTMAP_LAYER, a line in the list of layers of costmap.cmake, and a line in
/// layer_conformance_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"
#include "trident_nav/costmap/block_set.h"

namespace trident::nav {

/// What an update of a costmap begins with.
struct CostmapInput {
  double now_s = 0.0;  ///< On the clock that stamps the sensors' data [s].
  Pose2 robot;         ///< The base's pose in the costmap's frame.
};

/// A source of data that is too old to drive on.
struct StaleSource {
  std::string layer;
  std::string source;
  std::string topic;
  double age_s = 0.0;    ///< Infinite when nothing ever came [s].
  double limit_s = 0.0;  ///< [s]

  /// "scan (topic /scan) of layer obstacle_layer is 0.52 s old, its limit is 0.3 s".
  std::string text() const;
};

/// One layer. The costmap calls resize() before anything else and whenever its window moves or its
/// size changes, update() once per update, and, for the kind of layer that it is, combine() or
/// process() for what changed. All calls come from one thread at a time.
class Layer {
 public:
  explicit Layer(std::string name) : name_(std::move(name)) {}
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;
  virtual ~Layer() = default;

  const std::string& name() const { return name_; }
  bool is_enabled() const { return is_enabled_; }
  /// A layer that is not enabled takes in data, but leaves no costs.
  void set_enabled(bool is_enabled) { is_enabled_ = is_enabled; }

  /// The geometry that this layer wants the costmap to have: a static map's.
  virtual std::optional<GridGeometry> wanted_geometry() const { return std::nullopt; }
  virtual void set_footprint(const Footprint& /*footprint*/) {}
  /// Takes a geometry; what is known of cells that remain is kept.
  virtual void resize(const GridGeometry& geometry) = 0;
  /// Takes in what came since the last update, and adds the blocks whose costs changed.
  virtual void update(const CostmapInput& input, BlockSet& changed) = 0;
  /// Forgets what was sensed in a box, or outside of it. The next update finds what changed.
  enum class Side { kInside, kOutside };
  virtual void forget(const CellBox& /*box*/, Side /*side*/) {}
  /// Sources without which the costmap must not be driven on, at a time [s].
  virtual std::vector<StaleSource> stale_sources(double /*now_s*/) const { return {}; }

 private:
  std::string name_;
  bool is_enabled_ = true;
};

/// A layer whose cost of a cell depends on nothing but the cost below it there.
class CellLayer : public Layer {
 public:
  using Layer::Layer;
  /// Replaces the costs of the cells [x0, x1) of row y: those of the layers below are at cost[0] to
  /// cost[x1 - x0 - 1].
  virtual void combine(int y, int x0, int x1, std::uint8_t* cost) const = 0;
};

/// A layer whose cost of a cell depends on the costs below it around there.
class AreaLayer : public Layer {
 public:
  using Layer::Layer;
  /// Computes `above` from `below`, both rows without gaps. `changed` has the blocks of `below`
  /// that differ from those of the last call, all of them after a resize() or a change of
  /// parameters; on return, those of `above` that differ.
  virtual void process(const std::uint8_t* below, std::uint8_t* above, BlockSet& changed) = 0;
};

/// A layer that knows distances to the lethal cells of what it computes.
class DistanceSource {
 public:
  DistanceSource() = default;
  DistanceSource(const DistanceSource&) = delete;
  DistanceSource& operator=(const DistanceSource&) = delete;
  virtual ~DistanceSource() = default;
  /// Distances [m], cut at max_distance_m(); nullptr when they are not those to lethal cells.
  virtual const float* distance_m() const = 0;
  virtual float max_distance_m() const = 0;
  /// Distances up to this are to be exact [m].
  virtual void require_distance(double distance_m) = 0;
};

}  // namespace trident::nav
