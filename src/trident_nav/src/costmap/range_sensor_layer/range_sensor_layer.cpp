// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/range_sensor_layer.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::nav {
namespace {

constexpr double kScale = kLethalCost;  // a probability of 1
constexpr std::uint8_t kHalf = 127;
constexpr std::uint8_t kMin = 1, kMax = 253;
constexpr std::uint8_t kTarget = 233;  // what the measured point is taken as before the rule
constexpr double kConeLength = 1.2;    // of the measured range: what lies behind is considered

double cross(Cell a, Cell b, Cell c) {
  return static_cast<double>(b.x - a.x) * (c.y - a.y) -
         static_cast<double>(b.y - a.y) * (c.x - a.x);
}

/// True for cells of a triangle that is widened by a fraction of its area.
bool is_in_triangle(Cell o, Cell a, Cell b, Cell p, double widening) {
  const double least = -widening * std::abs(cross(a, b, o));
  const double turn = cross(a, b, o) < 0.0 ? -1.0 : 1.0;
  return turn * cross(a, b, p) >= least && turn * cross(b, o, p) >= least &&
         turn * cross(o, a, p) >= least;
}

/// Whether a reading's field of view and ranges are those of a sensor; NaN is not.
bool has_legal_limits(const RangeReading& reading) {
  return reading.field_of_view > 0.0 && reading.min_range >= 0.0 &&
         reading.max_range >= reading.min_range && std::isfinite(reading.max_range);
}

/// Whether the sensor knows one distance only, and says whether something is nearer.
bool is_of_fixed_distance(const RangeReading& reading, RangeSensorType type) {
  if (type != RangeSensorType::kAll) return type == RangeSensorType::kFixed;
  return reading.min_range == reading.max_range;
}

std::string fault_of(const RangeReading& reading, bool is_fixed) {
  if (!has_legal_limits(reading)) {
    return "a range reading has field_of_view " + number_text(reading.field_of_view) +
           " rad, min_range " + number_text(reading.min_range) + " m, max_range " +
           number_text(reading.max_range) +
           " m; a view > 0 and 0 <= min_range <= max_range are legal";
  }
  if (is_fixed && !std::isinf(reading.range)) {
    return "a range finder of one distance says " + number_text(reading.range) +
           " m; -infinity (obstacle) and infinity (none) are legal";
  }
  if (!is_fixed && !(reading.range >= reading.min_range && reading.range <= reading.max_range)) {
    return "a range reading of " + number_text(reading.range) + " m lies outside of [" +
           number_text(reading.min_range) + ", " + number_text(reading.max_range) + "] m";
  }
  return {};
}

}  // namespace

void RangeSensorLayerParams::validate() const {
  if (clear_threshold <= mark_threshold) return;
  throw Error("clear_threshold " + number_text(clear_threshold) +
              " must not exceed mark_threshold " + number_text(mark_threshold));
}

RangeSensorLayer::RangeSensorLayer(const LayerSetup& setup)
    : CellLayer(setup.name), params_(setup.params<Params>()), probability_(kHalf) {
  set_enabled(params_.enabled);
  ages_.assign(params_.topics.size(),
               SourceAge({params_.no_readings_timeout, params_.max_source_age}));
}

void RangeSensorLayer::set_params(const Params& params) {
  params.validate();
  const std::vector<std::string> topics = params_.topics;
  params_ = params;
  params_.topics = topics;
  set_enabled(params.enabled);
  changed_.insert_all();
}

std::string RangeSensorLayer::add_reading(std::size_t topic, const RangeReading& reading) {
  if (topic < ages_.size()) ages_[topic].note(reading.stamp_s);
  const bool is_fixed = is_of_fixed_distance(reading, params_.input_sensor_type);
  std::string fault = fault_of(reading, is_fixed);
  if (!fault.empty()) return fault;
  const bool is_nothing = is_fixed ? reading.range > 0.0 : reading.range >= reading.max_range;
  if (is_fixed && is_nothing && !params_.clear_on_max_reading) return {};
  const Eigen::Vector3d axis = reading.T_costmap_sensor.R * Eigen::Vector3d::UnitX();
  const double along = std::hypot(axis.x(), axis.y());
  const double range = (is_fixed ? reading.min_range : reading.range) * along;
  const Eigen::Vector3d& p = reading.T_costmap_sensor.p;
  pending_.push_back({{p.x(), p.y()},
                      std::atan2(axis.y(), axis.x()),
                      0.5 * reading.field_of_view,
                      range,
                      is_nothing && params_.clear_on_max_reading});
  return {};
}

void RangeSensorLayer::resize(const GridGeometry& geometry) {
  probability_.resize(geometry);
  changed_.resize(geometry.width, geometry.height);
}

void RangeSensorLayer::update(const CostmapInput& /*input*/, BlockSet& changed) {
  for (const Cone& cone : pending_) apply(cone);
  pending_.clear();
  changed.insert(changed_);
  changed_.clear();
}

void RangeSensorLayer::apply(const Cone& cone) {
  const GridGeometry& grid = probability_.geometry();
  const auto at = [&](double angle, double distance) {
    return grid.cell(cone.origin.x + std::cos(cone.yaw + angle) * distance,
                     cone.origin.y + std::sin(cone.yaw + angle) * distance);
  };
  const double length = kConeLength * cone.range;
  const Cell o = at(0.0, 0.0), tip = at(0.0, cone.range);
  const Cell a = at(-cone.half_angle, length), b = at(cone.half_angle, length);
  const Cell front = at(0.0, length);
  if (!cone.is_clear && grid.contains(tip)) set_probability(grid.index(tip), kTarget / kScale);
  const int x1 = std::min(std::max({o.x, a.x, b.x, front.x}), grid.width - 1);
  const int y1 = std::min(std::max({o.y, a.y, b.y, front.y}), grid.height - 1);
  for (int y = std::max(std::min({o.y, a.y, b.y, front.y}), 0); y <= y1; ++y) {
    for (int x = std::max(std::min({o.x, a.x, b.x, front.x}), 0); x <= x1; ++x) {
      const bool is_inside =
          params_.inflate_cone >= 1.0 || is_in_triangle(o, a, b, {x, y}, params_.inflate_cone);
      if (is_inside) update_cell(cone, {x, y});
    }
  }
}

void RangeSensorLayer::update_cell(const Cone& cone, Cell cell) {
  const GridGeometry& grid = probability_.geometry();
  const Point2 p = grid.center(cell);
  const double dx = p.x - cone.origin.x, dy = p.y - cone.origin.y;
  const double angle = wrap_angle(std::atan2(dy, dx) - cone.yaw);
  if (std::abs(angle) > cone.half_angle) return;
  const double distance = std::hypot(dx, dy);
  if (cone.is_clear && distance > cone.range) return;
  const std::size_t index = grid.index(cell);
  const double sensor = cone.is_clear ? 0.0 : occupancy_of(cone, distance, angle);
  const double prior = probability_.cells()[index] / kScale;
  const double occupied = sensor * prior, not_occupied = (1.0 - sensor) * (1.0 - prior);
  set_probability(index, occupied / (occupied + not_occupied));
}

double RangeSensorLayer::occupancy_of(const Cone& cone, double distance, double angle) const {
  const double off_axis = angle / cone.half_angle;
  const double trust = 0.5 * (1.0 - std::tanh(2.0 * (distance - params_.phi)));
  const double weight = trust * (1.0 - off_axis * off_axis);
  // Half of the arc's thickness grows with the range; costmaps' resolutions are its unit.
  const double half = probability_.geometry().resolution * cone.range;
  const double before = cone.range - distance;  // how far before the arc
  if (before > 2.0 * half) return 0.5 * (1.0 - weight);
  if (before > half) {
    const double rise = (2.0 * half - before) / half;
    return 0.5 * weight * rise * rise + 0.5 * (1.0 - weight);
  }
  if (before > -half) {
    const double fall = before / half;
    return 0.5 + weight * (0.5 - 0.5 * fall * fall);
  }
  return 0.5;
}

void RangeSensorLayer::set_probability(std::size_t cell, double probability) {
  const auto value = static_cast<std::uint8_t>(
      std::clamp(probability * kScale, static_cast<double>(kMin), static_cast<double>(kMax)));
  std::uint8_t& old = probability_.cells()[cell];
  if (old == value) return;
  old = value;
  const auto width = static_cast<std::size_t>(probability_.geometry().width);
  changed_.insert(static_cast<int>(cell % width), static_cast<int>(cell / width));
}

void RangeSensorLayer::combine(int y, int x0, int x1, std::uint8_t* cost) const {
  const std::uint8_t* own = probability_.row(y);
  const auto mark = static_cast<std::uint8_t>(params_.mark_threshold * kScale);
  const auto clear = static_cast<std::uint8_t>(params_.clear_threshold * kScale);
  for (int x = x0; x < x1; ++x) {
    std::uint8_t& below = cost[x - x0];
    if (own[x] > mark) {
      below = kLethalCost;
    } else if (own[x] < clear && below == kUnknownCost) {
      below = kFreeCost;
    }
  }
}

void RangeSensorLayer::forget(const CellBox& box, Side side) {
  const GridGeometry& grid = probability_.geometry();
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (box.contains(x, y) != (side == Side::kInside)) continue;
      set_probability(grid.index({x, y}), kHalf / kScale);
    }
  }
}

std::vector<StaleSource> RangeSensorLayer::stale_sources(double now_s) const {
  std::vector<StaleSource> result;
  for (std::size_t i = 0; i < ages_.size(); ++i) {
    if (!ages_[i].is_stale(now_s)) continue;
    result.push_back(
        {name(), params_.topics[i], params_.topics[i], ages_[i].age_s(now_s), ages_[i].limit_s()});
  }
  return result;
}

TRIDENT_COSTMAP_LAYER(range_sensor_layer, "RangeSensorLayer", RangeSensorLayer)

}  // namespace trident::nav
