// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/costmap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/string_util.h"
#include "trident_nav/costmap/layer_grid.h"

namespace trident::nav {
namespace {

/// For a tracker whose distances are read from its table.
class NoSink : public DistanceSink {
 public:
  void take(const DistanceSpan& /*span*/) override {}
};

GridGeometry valid_geometry(const CostmapParams& params) {
  params.validate();
  return params.geometry();
}

}  // namespace

std::string StaleSource::text() const {
  const std::string which = source + " (topic " + topic + ") of layer " + layer;
  if (std::isinf(age_s)) return which + " has sent nothing yet";
  return which + " is " + number_text(std::round(age_s * 1e3) / 1e3) + " s old, its limit is " +
         number_text(std::round(limit_s * 1e3) / 1e3) + " s";
}

Costmap::Costmap(CostmapParams params, std::vector<std::unique_ptr<Layer>> layers)
    : params_(std::move(params)),
      stack_(std::move(layers), params_.track_unknown_space ? kUnknownCost : kFreeCost),
      geometry_(valid_geometry(params_)),
      distances_(1.0) {
  set_footprint(params_.padded_footprint());
  stack_.resize(geometry_);
  distances_.resize(geometry_);
}

void Costmap::set_params(const CostmapParams& params) {
  params.validate();
  const Footprint footprint = params.padded_footprint();
  params_ = params;
  set_footprint(footprint);
}

void Costmap::set_footprint(const Footprint& footprint) {
  footprint_ = footprint;
  for (const auto& layer : stack_.layers()) layer->set_footprint(footprint);
  is_tracking_ = false;
}

/// The revision changes only with the costs, so that planners may keep what they have worked out.
void Costmap::update(const CostmapInput& input) {
  const GridGeometry next = next_geometry(input.robot);
  has_moved_ = !same_cells(geometry_, next);
  if (has_moved_) {
    geometry_ = next;
    stack_.resize(next);
    is_tracking_ = false;
  }
  if (DistanceSource* source = stack_.top_distances()) {
    source->require_distance(required_distance());
  }
  stack_.update(input);
  update_distances();
  note_revision();
}

void Costmap::note_revision() {
  if (!has_moved_ && stack_.changed().empty()) return;
  ++revision_;
  if (has_moved_ || row_revisions_.empty()) {
    row_revisions_.assign(static_cast<std::size_t>(geometry_.height), revision_);
  }
  stack_.changed().for_each_span(
      [this](int y, int, int) { row_revisions_[static_cast<std::size_t>(y)] = revision_; });
}

/// A free pose needs one look-up where the distance is known to exceed the circumscribed radius by
/// what the pose's and the obstacle's places within their cells can take away.
double Costmap::required_distance() const {
  return footprint_.circumscribed_radius + 2.0 * geometry_.resolution;
}

/// Distances of an inflation layer on top are those of the whole map, and cost nothing more. Else
/// they are tracked here; a map that has moved or was tracked elsewhere begins again with all its
/// blocks.
void Costmap::update_distances() {
  const DistanceSource* source = stack_.top_distances();
  if (source != nullptr && source->distance_m() != nullptr) {
    is_tracking_ = false;
    return;
  }
  NoSink sink;
  if (is_tracking_) {
    distances_.update(stack_.master(), stack_.changed(), sink);
    return;
  }
  distances_.set_max_distance(required_distance());
  distances_.resize(geometry_);
  BlockSet all(geometry_.width, geometry_.height);
  all.insert_all();
  distances_.update(stack_.master(), all, sink);
  is_tracking_ = true;
}

/// A rolling window moves by whole cells of the grid that begins at the configured origin: costs
/// keep their cells. A map that stands still follows the first layer that wants a size, the static
/// map's.
GridGeometry Costmap::next_geometry(const Pose2& robot) const {
  if (params_.rolling_window) {
    GridGeometry next = params_.geometry();
    const auto cells = [&](double center, double half, double origin) {
      return std::floor((center - half - origin) / next.resolution);
    };
    const double half_width = 0.5 * next.width * next.resolution;
    const double half_height = 0.5 * next.height * next.resolution;
    next.origin_x =
        params_.origin_x + cells(robot.x, half_width, params_.origin_x) * next.resolution;
    next.origin_y =
        params_.origin_y + cells(robot.y, half_height, params_.origin_y) * next.resolution;
    return next;
  }
  for (const auto& layer : stack_.layers()) {
    if (const auto wanted = layer->wanted_geometry()) return *wanted;
  }
  return params_.geometry();
}

CostGrid Costmap::grid() const {
  CostGrid grid;
  grid.geometry = geometry_;
  grid.cost = stack_.master();
  const DistanceSource* source = stack_.top_distances();
  const bool is_of_layer = source != nullptr && source->distance_m() != nullptr;
  grid.distance_m = is_of_layer ? source->distance_m() : distances_.distance_m();
  grid.max_distance_m = is_of_layer ? source->max_distance_m() : distances_.max_distance_m();
  grid.revision = revision_;
  grid.row_revisions = row_revisions_.empty() ? nullptr : row_revisions_.data();
  return grid;
}

std::vector<std::string> Costmap::forget(const Point2& center, double side_m, Layer::Side side,
                                         const std::vector<std::string>& names) {
  const Cell low = geometry_.cell(center.x - 0.5 * side_m, center.y - 0.5 * side_m);
  const Cell high = geometry_.cell(center.x + 0.5 * side_m, center.y + 0.5 * side_m);
  std::vector<std::string> asked;
  for (const auto& layer : stack_.layers()) {
    const bool is_named = std::find(names.begin(), names.end(), layer->name()) != names.end();
    if (!names.empty() && !is_named) continue;
    layer->forget({low.x, low.y, high.x + 1, high.y + 1}, side);
    asked.push_back(layer->name());
  }
  return asked;
}

std::vector<StaleSource> Costmap::stale_sources(double now_s) const {
  std::vector<StaleSource> result;
  for (const auto& layer : stack_.layers()) {
    if (!layer->is_enabled()) continue;
    for (StaleSource& source : layer->stale_sources(now_s)) result.push_back(std::move(source));
  }
  return result;
}

}  // namespace trident::nav
