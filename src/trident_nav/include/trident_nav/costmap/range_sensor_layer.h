// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_base/se3.h"
#include "trident_nav/costmap/layer.h"
#include "trident_nav/costmap/layer_factory.h"
#include "trident_nav/costmap/layer_grid.h"
#include "trident_nav/costmap/source_age.h"

namespace trident::nav {

/// Which range finders there are: fixed ones say yes (-infinity) or no (infinity) at one distance.
enum class RangeSensorType { kAll, kVariable, kFixed };
constexpr auto enum_names(RangeSensorType /*type*/) {
  return std::array{EnumName<RangeSensorType>{RangeSensorType::kAll, "ALL"},
                    EnumName<RangeSensorType>{RangeSensorType::kVariable, "VARIABLE"},
                    EnumName<RangeSensorType>{RangeSensorType::kFixed, "FIXED"}};
}

struct RangeSensorLayerParams {
  bool enabled = true;
  std::vector<std::string> topics;
  double phi = 1.2;
  double inflate_cone = 1.0;
  double no_readings_timeout = 0.0;
  double clear_threshold = 0.2;
  double mark_threshold = 0.8;
  bool clear_on_max_reading = false;
  RangeSensorType input_sensor_type = RangeSensorType::kAll;
  double max_source_age = -1.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("enabled", enabled, "the layer leaves costs");
    ar.field("topics", topics, "topics of the readings");
    ar.field("phi", phi, Range::non_negative(), "distance at which readings count half [m]");
    ar.field("inflate_cone", inflate_cone, Range{0.0, 1.0},
             "how much wider than its triangle the cone is taken; 1: all cells within its angle");
    ar.field("no_readings_timeout", no_readings_timeout, Range::non_negative(),
             "longest legal time between readings; 0: three periods, and at least 0.3 s [s]");
    ar.field("clear_threshold", clear_threshold, Range{0.0, 1.0},
             "cells of a lower probability are free");
    ar.field("mark_threshold", mark_threshold, Range{0.0, 1.0},
             "cells of a higher probability are lethal");
    ar.field("clear_on_max_reading", clear_on_max_reading,
             "readings of the largest range clear their cone");
    ar.field("input_sensor_type", input_sensor_type, "which range finders there are");
    ar.field("max_source_age", max_source_age,
             "how old the newest reading may be; 0: what no_readings_timeout says, or no limit; "
             "negative: see no_readings_timeout [s]");
  }
  /// Throws Error when clear_threshold exceeds mark_threshold.
  void validate() const;
};

/// One message of a range finder, which looks along its x axis.
struct RangeReading {
  double stamp_s = 0.0;
  double field_of_view = 0.0;  ///< Angle between the cone's sides [rad].
  double min_range = 0.0;      ///< [m]
  double max_range = 0.0;      ///< [m]
  double range = 0.0;          ///< [m]
  SE3 T_costmap_sensor;
};

/// Obstacles from sonars and infrared range finders: each cell has a probability, of which each
/// reading makes another by Bayes' rule with the sensor model of the range_sensor_layer package:
/// the arc at the measured range is likely occupied, the cone before it likely free, the less so
/// the farther from its axis (1 - (angle / half the view)^2) and from the sensor (a hyperbolic
/// tangent about phi). Probabilities stay within 1/254 of 0 and 1, so that no cell is ever stuck.
class RangeSensorLayer : public CellLayer {
 public:
  using Params = RangeSensorLayerParams;

  /// Read at the start alone.
  static constexpr std::array kFixedKeys = {"no_readings_timeout", "max_source_age"};

  explicit RangeSensorLayer(const LayerSetup& setup);

  const Params& params() const { return params_; }
  void set_params(const Params& params);

  /// Takes a reading of the topic with an index in params().topics. Returns what is wrong with it
  /// as a sentence; empty: it will be used.
  std::string add_reading(std::size_t topic, const RangeReading& reading);

  void resize(const GridGeometry& geometry) override;
  void update(const CostmapInput& input, BlockSet& changed) override;
  void combine(int y, int x0, int x1, std::uint8_t* cost) const override;
  void forget(const CellBox& box, Side side) override;
  std::vector<StaleSource> stale_sources(double now_s) const override;

 private:
  /// A reading in the plane.
  struct Cone {
    Point2 origin;
    double yaw, half_angle, range;
    bool is_clear;  ///< Nothing is in it.
  };

  void apply(const Cone& cone);
  void update_cell(const Cone& cone, Cell cell);
  double occupancy_of(const Cone& cone, double distance, double angle) const;
  void set_probability(std::size_t cell, double probability);

  Params params_;
  std::vector<SourceAge> ages_;
  LayerGrid<std::uint8_t> probability_;  // in 1/254
  std::vector<Cone> pending_;
  BlockSet changed_;
};

}  // namespace trident::nav
