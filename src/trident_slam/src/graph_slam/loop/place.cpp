// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "place.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

/// Resolution of what a scan shows to be free: one degree.
constexpr int kDirections = 360;

int direction_of(const Eigen::Vector2d& p) {
  const int direction =
      static_cast<int>((std::atan2(p.y(), p.x()) + kPi) * (kDirections / (2.0 * kPi)));
  return std::clamp(direction, 0, kDirections - 1);
}

/// How far a point is from the surface of a surfel, by its normal where it has one [m]; infinite
/// without a surfel.
double distance_to(const Surfel* surfel, const Eigen::Vector2f& p) {
  if (surfel == nullptr) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2f offset = p - surfel->mean;
  const bool has_normal = !surfel->normal.isZero(0.0F);
  return static_cast<double>(has_normal ? std::abs(offset.dot(surfel->normal)) : offset.norm());
}

}  // namespace

Place::Place(const KeyframeGraph& graph, int first, int last, int anchor,
             const FreeSpaceOptions& options)
    : options_(options) {
  const SE2 T_place_map = graph.pose(anchor).inverse();
  for (int i = graph.first_of(first); i < graph.end_of(last); ++i) {
    add(*graph[i].scan, T_place_map * graph.pose(i));
  }
}

Place::Place(const KeyframeGraph& graph, const std::vector<int>& keyframes,
             const FreeSpaceOptions& options)
    : options_(options) {
  for (const int i : keyframes) add(*graph[i].scan, graph.pose(i));
}

void Place::add(const PointScan& scan, const SE2& T_place_base) {
  scans_.push_back({T_place_base, &scan});
  const SE2 T_base_view = SE2::from_xy_yaw(static_cast<double>(scan.origin.x()),
                                           static_cast<double>(scan.origin.y()), 0.0);
  View view{(T_place_base * T_base_view).inverse(), std::vector<float>(kDirections, 0.0F)};
  for (const SurfacePoint& point : scan.points) {
    const Eigen::Vector2f p = point.p - scan.origin;
    float& nearest = view.nearest[direction_of(p.cast<double>())];
    const float range = p.norm();
    if (nearest == 0.0F || range < nearest) nearest = range;
  }
  views_.push_back(std::move(view));
}

void Place::insert_into(MaxPyramid* hits) const {
  for (const PlacedScan& placed : scans_) hits->insert(placed.T_place_base, *placed.scan);
}

SurfelMap Place::surfels(double cell) const {
  SurfelMap map(cell);
  for (const PlacedScan& placed : scans_) map.insert(placed.T_place_base, *placed.scan);
  return map;
}

bool Place::is_seen_free(const Eigen::Vector2d& p_place) const {
  for (const View& view : views_) {
    const Eigen::Vector2d p = view.T_view_place * p_place;
    const double range = p.norm();
    const double range_hit = static_cast<double>(view.nearest[direction_of(p)]);
    if (range_hit > 0.0 &&
        range < range_hit - options_.margin - options_.margin_per_meter * range_hit)
      return true;
  }
  return false;
}

/// Points on a surface of the place speak for the pose, points where beams have passed speak
/// against it; what lies in unknown space says nothing, and lowers the overlap.
Agreement Place::agreement(const SurfelMap& surfels, const PointScan& cloud,
                           const SE2& T_place_cloud) const {
  const Eigen::Matrix2d R = T_place_cloud.rotation();
  int on_surface = 0;
  int in_free_space = 0;
  for (const SurfacePoint& point : cloud.points) {
    const Eigen::Vector2d p = R * point.p.cast<double>() + T_place_cloud.p;
    const Surfel* surfel = surfels.nearest(p.cast<float>(), R.cast<float>() * point.normal, 3);
    if (distance_to(surfel, p.cast<float>()) < options_.on_surface) {
      ++on_surface;
    } else if (is_seen_free(p)) {
      ++in_free_space;
    }
  }
  Agreement result;
  const int known = on_surface + in_free_space;
  if (known > 0) result.ratio = static_cast<double>(on_surface) / known;
  if (!cloud.points.empty()) result.overlap = known / static_cast<double>(cloud.points.size());
  return result;
}

PointScan submap_cloud(const KeyframeGraph& graph, int submap, double cell) {
  SurfelMap surfels(cell);
  const SE2 T_anchor_map = graph.pose(graph.anchor_of(submap)).inverse();
  for (int i = graph.first_of(submap); i < graph.end_of(submap); ++i) {
    surfels.insert(T_anchor_map * graph.pose(i), *graph[i].scan);
  }
  PointScan cloud;
  cloud.points.reserve(surfels.surfels().size());
  for (const Surfel& surfel : surfels.surfels()) {
    cloud.points.push_back({surfel.mean, surfel.normal});
  }
  return cloud;
}

}  // namespace trident::slam
