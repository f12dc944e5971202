// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/beam_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/byte_rows.h"

namespace trident::nav {
namespace {

// Heights of points that lie on the edge of what counts may come out beyond it by rounding [m].
constexpr double kHeightRounding = 1e-6;
// So many cells are looked through for old marks in one update.
constexpr int kDecayCells = 1 << 20;

bool same_pose(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.yaw == b.yaw;
}

}  // namespace

BeamLayer::BeamLayer(const LayerSetup& setup, const BeamLayerParams& params)
    : CellLayer(setup.name), params_(params) {
  set_enabled(params.enabled);
  costs_.set_fill(params.track_unknown_space.value_or(setup.is_tracking_unknown) ? kUnknownCost
                                                                                 : kFreeCost);
  for (const auto& [name, source] : params.sources) sources_.emplace_back(name, source);
}

BeamSource* BeamLayer::find_source(const std::string& name) {
  for (BeamSource& source : sources_) {
    if (source.name() == name) return &source;
  }
  return nullptr;
}

void BeamLayer::set_beam_params(const BeamLayerParams& params) {
  set_enabled(params.enabled);
  if (params.combination_method != params_.combination_method) changed_.insert_all();
  const bool had_times = params_.decay_time > 0.0;
  params_ = params;
  if (had_times != (params.decay_time > 0.0)) {
    mark_times_s_ = LayerGrid<double>();
    if (!had_times) mark_times_s_.resize(geometry());
  }
}

void BeamLayer::resize(const GridGeometry& geometry) {
  costs_.resize(geometry);
  if (params_.decay_time > 0.0) mark_times_s_.resize(geometry);
  changed_.resize(geometry.width, geometry.height);
  is_all_fresh_ = true;
}

BeamLayer::Reach BeamLayer::reach_of(const BeamSourceParams& source) const {
  return {std::max(source.min_obstacle_height, params_.min_obstacle_height) - kHeightRounding,
          std::min(source.max_obstacle_height, params_.max_obstacle_height) + kHeightRounding,
          source.raytrace_min_range,
          source.raytrace_range,
          source.obstacle_min_range,
          source.obstacle_range,
          source.marking};
}

bool BeamLayer::has_news(const Pose2& robot) const {
  if (is_all_fresh_ || !last_robot_ || !same_pose(*last_robot_, robot)) return true;
  return std::any_of(sources_.begin(), sources_.end(),
                     [](const BeamSource& source) { return source.has_fresh(); });
}

void BeamLayer::update(const CostmapInput& input, BlockSet& changed) {
  if (has_news(input.robot)) {
    apply_data(input.now_s);
    if (params_.footprint_clearing_enabled) clear_footprint(input.robot);
    last_robot_ = input.robot;
  }
  if (params_.decay_time > 0.0) decay(input.now_s);
  changed.insert(changed_);
  changed_.clear();
}

void BeamLayer::find_kept_marks() {
  kept_.clear();
  for_each_stored([&](const BeamSource& source, const BeamSource::Stored& stored) {
    if (stored.is_fresh && source.params().marking) {
      find_kept_marks(stored.observation, reach_of(source.params()));
    }
  });
}

void BeamLayer::clear_fresh_beams() {
  for_each_stored([&](const BeamSource& source, const BeamSource::Stored& stored) {
    if (stored.is_fresh && source.params().clearing) {
      clear_beams(stored.observation, reach_of(source.params()));
    }
  });
}

void BeamLayer::mark_all_ends(double now_s) {
  for_each_stored([&](const BeamSource& source, const BeamSource::Stored& stored) {
    if (source.params().marking) {
      mark_ends(stored.observation, reach_of(source.params()), now_s);
    }
  });
}

/// Fresh beams clear first, then all sources mark: a mark of one sensor is not cleared by the beam
/// of another of the same moment. Marks that fresh beams see again are kept aside, so that clearing
/// does not take them away for an instant.
void BeamLayer::apply_data(double now_s) {
  if (is_all_fresh_) {
    for (BeamSource& source : sources_) source.set_fresh(true);
  }
  find_kept_marks();
  clear_fresh_beams();
  mark_all_ends(now_s);
  for (std::size_t i = 0; i < kept_.size(); ++i) restore_cell(kept_[i], i, now_s);
  for (BeamSource& source : sources_) source.set_fresh(false);
  is_all_fresh_ = false;
}

/// Ends of beams that are too far away to mark keep the marks of their cells and the neighbors.
void BeamLayer::find_kept_marks(const Observation& observation, const Reach& reach) {
  for (const BeamGroup& group : observation.groups) {
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const BeamEnd& end = observation.ends[i];
      const double z = group.origin.z() + static_cast<double>(end.p.z());
      if (!end.is_hit || z < reach.low_m || z > reach.high_m) continue;
      const double range = static_cast<double>(end.p.norm());
      if (range < reach.mark_to_m) continue;
      keep_around({group.origin.x() + static_cast<double>(end.p.x()),
                   group.origin.y() + static_cast<double>(end.p.y())});
    }
  }
}

void BeamLayer::keep_around(const Point2& p) {
  const Cell center = geometry().cell(p.x, p.y);
  for (int y = center.y - 1; y <= center.y + 1; ++y) {
    for (int x = center.x - 1; x <= center.x + 1; ++x) {
      if (!geometry().contains({x, y})) continue;
      const std::size_t cell = geometry().index({x, y});
      if (costs_.cells()[cell] != kLethalCost) continue;
      kept_.push_back(cell);
      keep_cell(cell);
    }
  }
}

void BeamLayer::clear_footprint(const Pose2& robot) {
  if (footprint_.circumscribed_radius <= 0.0) return;
  for (const CellRun& run : shape_.footprint(geometry(), footprint_, robot)) {
    const int x0 = std::max(run.x0, 0), x1 = std::min(run.x1, geometry().width);
    if (run.y < 0 || run.y >= geometry().height || x0 >= x1) continue;
    set_row(run.y, x0, x1, kFreeCost);
    free_cells(run.y, x0, x1);
  }
}

void BeamLayer::set_row(int y, int x0, int x1, std::uint8_t cost) {
  const std::size_t row = geometry().index({0, y});
  for (int x = x0; x < x1; ++x) set_cost(row + static_cast<std::size_t>(x), cost);
}

void BeamLayer::decay(double now_s) {
  const GridGeometry& grid = geometry();
  if (grid.size() == 0) return;
  const int rows = std::min(grid.height, std::max(1, kDecayCells / grid.width));
  for (int k = 0; k < rows; ++k) {
    if (next_decay_row_ >= grid.height) next_decay_row_ = 0;
    decay_row(next_decay_row_++, now_s);
  }
}

void BeamLayer::decay_row(int y, double now_s) {
  const std::size_t row = geometry().index({0, y});
  for (std::size_t i = row; i < row + static_cast<std::size_t>(geometry().width); ++i) {
    if (costs_.cells()[i] != kLethalCost) continue;
    if (now_s - mark_times_s_.cells()[i] <= params_.decay_time) continue;
    set_cost(i, costs_.fill());
    const int x = static_cast<int>(i - row);
    forget_cells(y, x, x + 1);
  }
}

void BeamLayer::forget(const CellBox& box, Side side) {
  const GridGeometry& grid = geometry();
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (box.contains(x, y) != (side == Side::kInside)) continue;
      set_cost(grid.index({x, y}), costs_.fill());
      forget_cells(y, x, x + 1);
    }
  }
  is_all_fresh_ = true;
}

/// The methods of nav2's costmap, several cells at a time.
void BeamLayer::combine(int y, int x0, int x1, std::uint8_t* cost) const {
  const std::uint8_t* own = costs_.row(y) + x0;
  const Bytes unknown = all_bytes(kUnknownCost);
  switch (static_cast<Combination>(params_.combination_method)) {
    case Combination::kOverwrite:
      return combine_row(own, x1 - x0, cost, [&](const Bytes& below, const Bytes& here) {
        return here == unknown ? below : here;
      });
    case Combination::kMaximum:
      return combine_row(own, x1 - x0, cost, maximum_of_known);
    case Combination::kMaximumKeepUnknown:
      return combine_row(own, x1 - x0, cost, [&](const Bytes& below, const Bytes& here) {
        return here == unknown ? below : larger(below, here);
      });
    case Combination::kNothing:
      return;
  }
}

std::vector<StaleSource> BeamLayer::stale_sources(double now_s) const {
  std::vector<StaleSource> result;
  for (const BeamSource& source : sources_) {
    if (!source.age().is_stale(now_s)) continue;
    result.push_back(
        {name(), source.name(), source.topic(), source.age().age_s(now_s), source.age().limit_s()});
  }
  return result;
}

}  // namespace trident::nav
