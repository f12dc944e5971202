// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/denoise_layer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "trident_base/error.h"

namespace trident::nav {
namespace {

/// The neighbors by an edge, then those by a corner.
constexpr std::array<Cell, 8> kNeighbors{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

}  // namespace

void DenoiseLayerParams::validate() const {
  if (group_connectivity_type == 4 || group_connectivity_type == 8) return;
  throw Error("group_connectivity_type is " + std::to_string(group_connectivity_type) +
              "; 4 and 8 are legal");
}

DenoiseLayer::DenoiseLayer(const LayerSetup& setup)
    : AreaLayer(setup.name), params_(setup.params<Params>()) {
  set_enabled(params_.enabled);
}

void DenoiseLayer::set_params(const Params& params) {
  params.validate();
  params_ = params;
  set_enabled(params.enabled);
  is_everything_new_ = true;
}

void DenoiseLayer::resize(const GridGeometry& geometry) {
  geometry_ = geometry;
  around_.resize(geometry.width, geometry.height);
  is_everything_new_ = true;
}

void DenoiseLayer::update(const CostmapInput& /*input*/, BlockSet& changed) {
  if (is_everything_new_) changed.insert_all();
  is_everything_new_ = false;
}

void DenoiseLayer::process(const std::uint8_t* below, std::uint8_t* above, BlockSet& changed) {
  widen(changed);
  changed.clear();
  around_.for_each_span(
      [&](int y, int x0, int x1) { filter_span(y, x0, x1, below, above, changed); });
}

/// A cell that changes joins or splits groups; those that are small before or after lie within so
/// many steps of it.
void DenoiseLayer::widen(const BlockSet& changed) {
  const int steps = std::max(params_.minimal_group_size, 1) - 1;
  around_.clear();
  changed.for_each_span([&](int y, int x0, int x1) {
    const int last = std::min(y + steps, geometry_.height - 1);
    for (int row = std::max(y - steps, 0); row <= last; ++row) {
      around_.insert_span(row, x0 - steps, x1 + steps);
    }
  });
}

void DenoiseLayer::filter_span(int y, int x0, int x1, const std::uint8_t* below,
                               std::uint8_t* above, BlockSet& changed) {
  for (int x = x0; x < x1; ++x) {
    const std::size_t cell = geometry_.index({x, y});
    std::uint8_t cost = below[cell];
    if (cost == kLethalCost && is_noise({x, y}, below)) cost = kFreeCost;
    if (above[cell] == cost) continue;
    above[cell] = cost;
    changed.insert(x, y);
  }
}

/// Searches the cell's group until it is large enough.
bool DenoiseLayer::is_noise(Cell cell, const std::uint8_t* below) {
  const auto enough = static_cast<std::size_t>(std::max(params_.minimal_group_size, 1));
  const auto neighbors = static_cast<std::size_t>(params_.group_connectivity_type);
  group_.assign(1, cell);
  for (std::size_t i = 0; i < group_.size() && group_.size() < enough; ++i) {
    for (std::size_t k = 0; k < neighbors && group_.size() < enough; ++k) {
      const Cell next{group_[i].x + kNeighbors[k].x, group_[i].y + kNeighbors[k].y};
      if (!geometry_.contains(next) || below[geometry_.index(next)] != kLethalCost) continue;
      if (std::find(group_.begin(), group_.end(), next) == group_.end()) group_.push_back(next);
    }
  }
  return group_.size() < enough;
}

TRIDENT_COSTMAP_LAYER(denoise_layer, "DenoiseLayer", DenoiseLayer)

}  // namespace trident::nav
