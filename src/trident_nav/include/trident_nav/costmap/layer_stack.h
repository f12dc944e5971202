// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trident_nav/costmap/layer.h"

namespace trident::nav {

/// Layers from the lowest to the highest and the costs that they make together. Neighboring layers
/// of cells are combined in one pass over what changed in any of them; what that changes is the
/// input of the next layer of areas, and so on up to the master costs.
class LayerStack {
 public:
  /// `background`: the cost of a cell that no layer says anything of.
  LayerStack(std::vector<std::unique_ptr<Layer>> layers, std::uint8_t background);

  /// Gives all layers a geometry.
  void resize(const GridGeometry& geometry);
  /// Takes in what the layers have got and computes what changed.
  void update(const CostmapInput& input);

  /// One byte a cell, rows without gaps.
  const std::uint8_t* master() const;
  /// Blocks of the master costs that the latest update changed.
  const BlockSet& changed() const;
  /// The highest enabled layer if it knows the distances to lethal cells; nullptr otherwise.
  DistanceSource* top_distances() const;

  const std::vector<std::unique_ptr<Layer>>& layers() const { return layers_; }
  /// nullptr when no layer has the name.
  Layer* find(const std::string& name) const;

 private:
  /// Layers of cells that are combined together, or one of areas, and the costs above them.
  struct Stage {
    std::vector<CellLayer*> cells;
    AreaLayer* area = nullptr;
    std::vector<std::uint8_t> output;
    BlockSet changed;
  };

  bool enabled_changed() const;
  void add_to_stages(Layer* layer);
  void arrange_stages();
  void resize_stages();
  void collect_changes(std::size_t index, const CostmapInput& input);
  void update_stage(std::size_t index, const CostmapInput& input);
  void combine(const std::uint8_t* below, Stage& stage);
  void combine_span(const std::uint8_t* below, int y, int x0, int x1, Stage& stage);

  std::vector<std::unique_ptr<Layer>> layers_;
  std::uint8_t background_;
  GridGeometry geometry_;
  std::vector<bool> enabled_;  // as the stages were arranged
  std::vector<Stage> stages_;
  bool is_everything_new_ = true;
  std::vector<std::uint8_t> row_;
  BlockSet before_;
};

}  // namespace trident::nav
