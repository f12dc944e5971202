// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_nav/costmap/layer.h"
#include "trident_nav/costmap/layer_factory.h"

namespace trident::nav {

struct DenoiseLayerParams {
  bool enabled = true;
  int minimal_group_size = 2;
  int group_connectivity_type = 8;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("enabled", enabled, "the layer removes noise");
    ar.field("minimal_group_size", minimal_group_size, Range{0, 1000},
             "groups of fewer lethal cells are removed; 0, 1: none are");
    ar.field("group_connectivity_type", group_connectivity_type,
             "8: cells that touch at a corner are of one group; 4: they are not");
  }
  /// Throws Error unless the connectivity is 4 or 8.
  void validate() const;
};

/// Makes lethal cells free where fewer than minimal_group_size of them are connected. Unknown cells
/// are left alone, and so is what is no obstacle.
class DenoiseLayer : public AreaLayer {
 public:
  using Params = DenoiseLayerParams;

  explicit DenoiseLayer(const LayerSetup& setup);

  const Params& params() const { return params_; }
  void set_params(const Params& params);

  void resize(const GridGeometry& geometry) override;
  void update(const CostmapInput& input, BlockSet& changed) override;
  void process(const std::uint8_t* below, std::uint8_t* above, BlockSet& changed) override;

 private:
  void widen(const BlockSet& changed);
  void filter_span(int y, int x0, int x1, const std::uint8_t* below, std::uint8_t* above,
                   BlockSet& changed);
  bool is_noise(Cell cell, const std::uint8_t* below);

  Params params_;
  GridGeometry geometry_;
  bool is_everything_new_ = true;
  BlockSet around_;          // blocks that a change may reach
  std::vector<Cell> group_;  // found so far
};

}  // namespace trident::nav
