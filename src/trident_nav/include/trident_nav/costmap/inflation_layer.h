// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_nav/costmap/distance_tracker.h"
#include "trident_nav/costmap/layer.h"
#include "trident_nav/costmap/layer_factory.h"

namespace trident::nav {

struct InflationLayerParams {
  bool enabled = true;
  double inflation_radius = 0.55;
  double cost_scaling_factor = 10.0;
  bool inflate_unknown = false;
  bool inflate_around_unknown = false;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("enabled", enabled, "the layer leaves costs");
    ar.field("inflation_radius", inflation_radius, Range::non_negative(),
             "how far obstacles raise costs [m]");
    ar.field("cost_scaling_factor", cost_scaling_factor, Range::non_negative(),
             "how fast costs fall outside of the inscribed radius [1/m]");
    ar.field("inflate_unknown", inflate_unknown, "unknown cells get costs above 0, too");
    ar.field("inflate_around_unknown", inflate_around_unknown, "unknown cells count as obstacles");
  }
};

/// Costs around lethal cells by the distance d between centers of cells: 254 at d = 0, 253 up to
/// the footprint's inscribed radius r, then 252 exp(-cost_scaling_factor (d - r)) rounded down, and
/// nothing beyond inflation_radius (costmap_2d's formula). Cells keep what is higher; an unknown
/// cell stays so unless it gets 253 or more, or, with inflate_unknown, more than 0.
class InflationLayer : public AreaLayer, public DistanceSource, private DistanceSink {
 public:
  using Params = InflationLayerParams;

  explicit InflationLayer(const LayerSetup& setup);

  const Params& params() const { return params_; }
  void set_params(const Params& params);

  void set_footprint(const Footprint& footprint) override;
  void resize(const GridGeometry& geometry) override;
  void update(const CostmapInput& input, BlockSet& changed) override;
  void process(const std::uint8_t* below, std::uint8_t* above, BlockSet& changed) override;

  const float* distance_m() const override;
  float max_distance_m() const override { return tracker_.max_distance_m(); }
  void require_distance(double distance_m) override;

 private:
  void take(const DistanceSpan& span) override;
  void prepare();
  std::uint8_t cost_at(double distance_m) const;
  void inflate(const DistanceSpan& span, const std::uint8_t* below, std::uint8_t* above);

  Params params_;
  double inscribed_radius_ = 0.0;
  double required_distance_m_ = 0.0;
  GridGeometry geometry_;
  DistanceTracker tracker_;
  std::vector<std::uint8_t> table_;  // costs by squared distance [cells^2]
  std::vector<std::uint8_t> row_;
  bool is_prepared_ = false;
  const std::uint8_t* below_ = nullptr;  // during process()
  std::uint8_t* above_ = nullptr;
  BlockSet changed_above_;
};

}  // namespace trident::nav
