// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/static_layer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/byte_rows.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_nav/costmap/layer_grid.h"

namespace trident::nav {
namespace {

constexpr double kTurned = 1e-9;  // [rad]
// Stands for cells outside of the map; no occupancy has this cost.
constexpr std::uint8_t kNothing = kInscribedCost;

/// The smallest box with sides along the axes that has a turned grid's corners.
GridGeometry bounding_grid(const GridGeometry& grid, const SE2& T_costmap_grid) {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(INFINITY), most = -least;
  for (const double x : {0.0, grid.width * grid.resolution}) {
    for (const double y : {0.0, grid.height * grid.resolution}) {
      const Eigen::Vector2d corner = T_costmap_grid * Eigen::Vector2d(x, y);
      least = least.cwiseMin(corner);
      most = most.cwiseMax(corner);
    }
  }
  const Eigen::Vector2d cells = (most - least) / grid.resolution;
  return {static_cast<int>(std::ceil(cells.x() - kTurned)),
          static_cast<int>(std::ceil(cells.y() - kTurned)), grid.resolution, least.x(), least.y()};
}

bool is_finite(const SE2& T) { return T.p.allFinite() && std::isfinite(T.angle); }

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

void require_valid(const OccupancyGrid& map) {
  if (!is_positive(map.resolution)) {
    throw Error("the map's resolution is " + number_text(map.resolution) + " m; it must be > 0");
  }
  if (map.width <= 0 || map.height <= 0) {
    throw Error("the map has " + std::to_string(map.width) + " x " + std::to_string(map.height) +
                " cells; it must have at least one");
  }
  if (!is_finite(map.T_map_origin)) throw Error("the map's origin must be finite");
  if (map.cells.size() != map.index(0, map.height)) {
    throw Error("the map has " + std::to_string(map.cells.size()) + " values for its " +
                std::to_string(map.width) + " x " + std::to_string(map.height) + " cells");
  }
}

}  // namespace

StaticLayer::StaticLayer(const LayerSetup& setup)
    : CellLayer(setup.name), params_(setup.params<Params>()) {
  set_enabled(params_.enabled);
  fill_table();
}

void StaticLayer::fill_table() {
  const auto unknown = static_cast<std::uint8_t>(params_.unknown_cost_value);
  for (int value = 0; value < 256; ++value) {
    std::uint8_t& cost = table_[static_cast<std::size_t>(value)];
    if (value == unknown) {
      cost = params_.track_unknown_space ? kUnknownCost : kFreeCost;
    } else if (value >= params_.lethal_cost_threshold) {
      cost = kLethalCost;
    } else if (params_.trinary_costmap) {
      cost = kFreeCost;
    } else {
      const double fraction = static_cast<double>(value) / params_.lethal_cost_threshold;
      cost = static_cast<std::uint8_t>(fraction * kLethalCost);
    }
  }
}

/// Whether a new map's cells lie where those of the present one do.
bool StaticLayer::is_in_place(const OccupancyGrid& map) const {
  if (!has_map() || map.width != map_.width || map.height != map_.height) return false;
  const SE2 moved = T_map_grid_.inverse() * map.T_map_origin;
  return map.resolution == map_.resolution && moved.p.isZero(0.0) && moved.angle == 0.0;
}

void StaticLayer::set_params(const Params& params) {
  set_enabled(params.enabled);
  params_.enabled = params.enabled;
  if (params_.use_maximum == params.use_maximum) return;
  params_.use_maximum = params.use_maximum;
  changed_.insert_all();
}

bool StaticLayer::set_map(const OccupancyGrid& map) {
  if (has_map() && params_.first_map_only) return false;
  require_valid(map);
  const bool is_same_place = is_in_place(map);
  map_ = {map.width, map.height, map.resolution, 0.0, 0.0};
  T_map_grid_ = map.T_map_origin;
  if (!is_same_place) {
    costs_.assign(map_.size(), kUnknownCost);
    place();
  }
  for (int y = 0; y < map_.height; ++y) {
    replace_row(y, 0, map_.width, map.cells.data() + map.index(0, y));
  }
  if (!sampled_.empty()) sample();
  return true;
}

/// Whether a part that is not empty lies within the map.
bool StaticLayer::is_inside(const CellBox& part) const {
  return !part.empty() && part.x0 >= 0 && part.y0 >= 0 && part.x1 <= map_.width &&
         part.y1 <= map_.height;
}

void StaticLayer::update_map(const CellBox& part, const std::vector<std::int8_t>& occupancy) {
  const auto width = static_cast<std::size_t>(std::max(part.x1 - part.x0, 0));
  const auto height = static_cast<std::size_t>(std::max(part.y1 - part.y0, 0));
  if (!is_inside(part) || occupancy.size() != width * height) {
    throw Error("a map update of columns " + std::to_string(part.x0) + " to " +
                std::to_string(part.x1) + ", rows " + std::to_string(part.y0) + " to " +
                std::to_string(part.y1) + " with " + std::to_string(occupancy.size()) +
                " values does not fit the map of " + std::to_string(map_.width) + " x " +
                std::to_string(map_.height) + " cells");
  }
  for (int y = part.y0; y < part.y1; ++y) {
    replace_row(y, part.x0, part.x1,
                occupancy.data() + static_cast<std::size_t>(y - part.y0) * width);
  }
  if (!sampled_.empty()) sample();
}

/// Replaces the costs of a row of the map, and notes the blocks of the costmap that this changes.
void StaticLayer::replace_row(int y, int x0, int x1, const std::int8_t* occupancy) {
  std::uint8_t* costs = costs_.data() + map_.index({0, y});
  const int row = y - offset_.y;
  const bool is_direct = sampled_.empty() && row >= 0 && row < changed_.height();
  for (int x = x0; x < x1; x += BlockSet::kCells) {
    const int end = std::min(x + BlockSet::kCells, x1);
    bool is_changed = false;
    for (int i = x; i < end; ++i) {
      const std::uint8_t cost = table_[static_cast<std::uint8_t>(occupancy[i - x0])];
      is_changed |= cost != costs[i];
      costs[i] = cost;
    }
    if (is_changed && is_direct) changed_.insert_span(row, x - offset_.x, end - offset_.x);
  }
}

void StaticLayer::set_map_pose(const SE2& T_costmap_map) {
  if (T_costmap_map.p == T_costmap_map_.p && T_costmap_map.angle == T_costmap_map_.angle) return;
  T_costmap_map_ = T_costmap_map;
  if (has_map()) place();
}

bool StaticLayer::is_turned() const {
  return std::abs((T_costmap_map_ * T_map_grid_).angle) > kTurned;
}

GridGeometry StaticLayer::map_in_costmap() const {
  const SE2 T_costmap_grid = T_costmap_map_ * T_map_grid_;
  GridGeometry grid = map_;
  grid.origin_x = T_costmap_grid.p.x();
  grid.origin_y = T_costmap_grid.p.y();
  return grid;
}

std::optional<GridGeometry> StaticLayer::wanted_geometry() const {
  if (!has_map()) return std::nullopt;
  return is_turned() ? bounding_grid(map_, T_costmap_map_ * T_map_grid_) : map_in_costmap();
}

void StaticLayer::resize(const GridGeometry& geometry) {
  geometry_ = geometry;
  changed_.resize(geometry.width, geometry.height);
  if (has_map()) place();
}

/// Finds how the costmap's cells lie among those of the map.
void StaticLayer::place() {
  const auto offset = whole_cell_offset(map_in_costmap(), geometry_);
  sampled_.clear();
  if (offset && !is_turned()) {
    offset_ = *offset;
  } else {
    sampled_.resize(geometry_.size());
    sample();
  }
  changed_.insert_all();
}

void StaticLayer::sample() {
  const SE2 T_grid_costmap = (T_costmap_map_ * T_map_grid_).inverse();
  const Eigen::Matrix2d R = T_grid_costmap.rotation();
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      const Point2 center = geometry_.center({x, y});
      const Eigen::Vector2d p = R * Eigen::Vector2d(center.x, center.y) + T_grid_costmap.p;
      const Cell cell = map_.cell(p.x(), p.y());
      sampled_[geometry_.index({x, y})] = map_.contains(cell) ? costs_[map_.index(cell)] : kNothing;
    }
  }
  changed_.insert_all();
}

void StaticLayer::update(const CostmapInput& /*input*/, BlockSet& changed) {
  changed.insert(changed_);
  changed_.clear();
}

void StaticLayer::combine(int y, int x0, int x1, std::uint8_t* cost) const {
  if (!has_map()) return;
  if (!sampled_.empty()) {
    put_row(sampled_.data() + geometry_.index({x0, y}), x1 - x0, cost);
    return;
  }
  const int row = y + offset_.y;
  if (row < 0 || row >= map_.height) return;
  const int first = std::max(x0, -offset_.x), end = std::min(x1, map_.width - offset_.x);
  if (first >= end) return;
  const std::uint8_t* from = costs_.data() + map_.index({first + offset_.x, row});
  put_row(from, end - first, cost + (first - x0));
}

/// Lays a row of costs over those of the layers below.
void StaticLayer::put_row(const std::uint8_t* from, int count, std::uint8_t* cost) const {
  if (params_.use_maximum) {
    combine_row(from, count, cost, [](const Bytes& below, const Bytes& own) {
      const Bytes known = own == all_bytes(kNothing) ? all_bytes(kUnknownCost) : own;
      return maximum_of_known(below, known);
    });
  } else if (sampled_.empty()) {
    std::memcpy(cost, from, static_cast<std::size_t>(count));
  } else {
    combine_row(from, count, cost, [](const Bytes& below, const Bytes& own) {
      return own == all_bytes(kNothing) ? below : own;
    });
  }
}

TRIDENT_COSTMAP_LAYER(static_layer, "StaticLayer", StaticLayer)

}  // namespace trident::nav
