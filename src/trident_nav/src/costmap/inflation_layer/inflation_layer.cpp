// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/inflation_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/byte_rows.h"

namespace trident::nav {
namespace {

// Distances of whole cells that should equal a radius may differ from it by rounding [m].
constexpr double kRadiusRounding = 1e-9;

DistanceTracker::Seeds seeds_of(const InflationLayerParams& params) {
  return params.inflate_around_unknown ? DistanceTracker::Seeds::kLethalOrUnknown
                                       : DistanceTracker::Seeds::kLethal;
}

}  // namespace

InflationLayer::InflationLayer(const LayerSetup& setup)
    : AreaLayer(setup.name),
      params_(setup.params<Params>()),
      tracker_(params_.inflation_radius, seeds_of(params_)) {
  set_enabled(params_.enabled);
}

void InflationLayer::set_params(const Params& params) {
  params_ = params;
  set_enabled(params.enabled);
  is_prepared_ = false;
}

void InflationLayer::set_footprint(const Footprint& footprint) {
  if (footprint.inscribed_radius == inscribed_radius_) return;
  inscribed_radius_ = footprint.inscribed_radius;
  is_prepared_ = false;
}

void InflationLayer::require_distance(double distance_m) {
  if (distance_m == required_distance_m_) return;
  required_distance_m_ = distance_m;
  is_prepared_ = false;
}

void InflationLayer::resize(const GridGeometry& geometry) {
  geometry_ = geometry;
  is_prepared_ = false;
}

const float* InflationLayer::distance_m() const {
  return params_.inflate_around_unknown || !is_prepared_ ? nullptr : tracker_.distance_m();
}

void InflationLayer::update(const CostmapInput& /*input*/, BlockSet& changed) {
  if (is_prepared_) return;
  prepare();
  changed.insert_all();
}

void InflationLayer::prepare() {
  tracker_ =
      DistanceTracker(std::max(params_.inflation_radius, required_distance_m_), seeds_of(params_));
  tracker_.resize(geometry_);
  table_.assign(static_cast<std::size_t>(tracker_.beyond()) + 1, kFreeCost);
  for (int square = 0; square < tracker_.beyond(); ++square) {
    const double distance = std::sqrt(static_cast<double>(square)) * geometry_.resolution;
    table_[static_cast<std::size_t>(square)] = cost_at(distance);
  }
  row_.resize(static_cast<std::size_t>(geometry_.width));
  changed_above_.resize(geometry_.width, geometry_.height);
  is_prepared_ = true;
}

std::uint8_t InflationLayer::cost_at(double distance_m) const {
  if (distance_m == 0.0) return kLethalCost;
  if (distance_m > params_.inflation_radius + kRadiusRounding) return kFreeCost;
  if (distance_m <= inscribed_radius_) return kInscribedCost;
  const double factor = std::exp(-params_.cost_scaling_factor * (distance_m - inscribed_radius_));
  return static_cast<std::uint8_t>((kInscribedCost - 1) * factor);
}

void InflationLayer::process(const std::uint8_t* below, std::uint8_t* above, BlockSet& changed) {
  below_ = below;
  above_ = above;
  changed_above_.clear();
  tracker_.update(below, changed, *this);
  std::swap(changed, changed_above_);
}

void InflationLayer::take(const DistanceSpan& span) {
  const std::size_t first = geometry_.index({span.x0, span.y});
  const std::uint8_t* costs = below_ + first;
  if (span.square != nullptr) {
    inflate(span, costs, row_.data());
    costs = row_.data();
  }
  std::uint8_t* above = above_ + first;
  for (int i = 0; i < span.x1 - span.x0; i += BlockSet::kCells) {
    const int cells = std::min(BlockSet::kCells, span.x1 - span.x0 - i);
    if (replace_block(costs + i, cells, above + i)) changed_above_.insert(span.x0 + i, span.y);
  }
}

void InflationLayer::inflate(const DistanceSpan& span, const std::uint8_t* below,
                             std::uint8_t* above) {
  const int count = span.x1 - span.x0;
  for (int i = 0; i < count; ++i) above[i] = table_[span.square[i]];
  // Unknown is the largest number: it stays the larger one, unless the cost reaches a threshold.
  const Bytes threshold = all_bytes(params_.inflate_unknown ? 1 : kInscribedCost);
  combine_row(below, count, above, [&](const Bytes& cost, const Bytes& old) {
    const Bytes replaces = (old == all_bytes(kUnknownCost)) & (cost >= threshold);
    return replaces ? cost : larger(old, cost);
  });
}

TRIDENT_COSTMAP_LAYER(inflation_layer, "InflationLayer", InflationLayer)

}  // namespace trident::nav
