// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "stale_scans.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

constexpr int kDirections = 360;
/// What was passed on a shorter way than this is the newest scan's own surroundings [m].
constexpr double kLongAgo = 20.0;
/// Part of a scan's points that newer ones must have seen before it goes.
constexpr double kSeenAgain = 0.9;
/// A point this much before what a beam met was seen through [m], plus a part of the range.
constexpr double kMargin = 0.3;
constexpr double kMarginPerMetre = 0.03;

using Box = Eigen::AlignedBox2d;

Box box_of(const PointScan& scan, const SE2& T_map_base) {
  Box box(T_map_base * scan.origin.cast<double>());
  for (const SurfacePoint& point : scan.points) box.extend(T_map_base * point.p.cast<double>());
  return box;
}

double area(const Box& box) { return box.isEmpty() ? 0.0 : box.volume(); }

std::vector<int> edges_per_keyframe(const KeyframeGraph& graph) {
  std::vector<int> counts(static_cast<std::size_t>(graph.size()));
  for (const GraphEdge& edge : graph.edges()) {
    ++counts[static_cast<std::size_t>(edge.from)];
    ++counts[static_cast<std::size_t>(edge.to)];
  }
  return counts;
}

}  // namespace

/// What one scan met, by direction.
class StaleScans::View {
 public:
  View(const PointScan& scan, const SE2& T_map_base)
      : T_view_map_((T_map_base * SE2::from_xy_yaw(static_cast<double>(scan.origin.x()),
                                                   static_cast<double>(scan.origin.y()), 0.0))
                        .inverse()) {
    nearest_.fill(std::numeric_limits<double>::infinity());
    farthest_.fill(0.0);
    for (const SurfacePoint& point : scan.points) {
      const Eigen::Vector2d p = (point.p - scan.origin).cast<double>();
      const std::size_t d = direction_of(p);
      nearest_[d] = std::min(nearest_[d], p.norm());
      farthest_[d] = std::max(farthest_[d], p.norm());
    }
  }

  /// Met again, or seen through.
  bool has_seen(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d p = T_view_map_ * p_map;
    const double met = farthest_[direction_of(p)];
    return met > 0.0 && p.norm() < met + margin(met);
  }
  bool has_seen_through(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d p = T_view_map_ * p_map;
    const std::size_t d = direction_of(p);
    double met = std::numeric_limits<double>::infinity();
    for (const std::size_t beside : {kDirections - 1, 0, 1}) {
      const std::size_t i = (d + beside) % kDirections;
      if (farthest_[i] <= 0.0) return false;
      met = std::min(met, nearest_[i]);
    }
    return p.norm() < met - margin(met);
  }

 private:
  static double margin(double range) { return kMargin + kMarginPerMetre * range; }
  static std::size_t direction_of(const Eigen::Vector2d& p) {
    const auto d = static_cast<int>((std::atan2(p.y(), p.x()) + kPi) * (kDirections / (2.0 * kPi)));
    return static_cast<std::size_t>(std::clamp(d, 0, kDirections - 1));
  }

  SE2 T_view_map_;
  std::array<double, kDirections> nearest_{};
  std::array<double, kDirections> farthest_{};
};

/// Older keyframes within `radius` [m] of the newest one: all, or those that edges lead to without
/// leaving the circle.
std::vector<int> StaleScans::candidates(const KeyframeGraph& graph, double radius) const {
  const int newest = graph.size() - 1;
  const auto count = static_cast<std::size_t>(graph.size());
  std::vector<char> is_near(count);
  for (int i = 0; i <= newest; ++i) {
    is_near[i] = (graph.pose(i).p - graph.pose(newest).p).norm() < radius ? 1 : 0;
  }
  if (!options_.search_use_tree) {
    std::vector<char> is_linked(count);
    is_linked[newest] = 1;
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      for (const GraphEdge& edge : graph.edges()) {
        if (is_linked[edge.from] == is_linked[edge.to] || !is_near[edge.from] || !is_near[edge.to])
          continue;
        is_linked[edge.from] = is_linked[edge.to] = 1;
        has_grown = true;
      }
    }
    is_near = is_linked;
  }
  std::vector<int> result;
  for (int i = 0; i < newest; ++i) {
    const bool is_old = graph[newest].travelled - graph[i].travelled > kLongAgo;
    if (is_near[i] != 0 && is_old && !graph[i].scan->points.empty()) result.push_back(i);
  }
  return result;
}

StaleScans::Memory& StaleScans::memory_of(const KeyframeGraph& graph, int keyframe) {
  const auto i = static_cast<std::size_t>(keyframe);
  if (memories_.size() <= i) memories_.resize(static_cast<std::size_t>(graph.size()));
  Memory& memory = memories_[i];
  if (memory.scan != graph[keyframe].scan) {
    memory.scan = graph[keyframe].scan;
    memory.seen_again.assign(memory.scan->points.size(), 0);
  }
  return memory;
}

bool StaleScans::is_replaced(const Memory& memory) const {
  const auto seen = std::count(memory.seen_again.begin(), memory.seen_again.end(), 1);
  return memory.score < options_.node_removal_score &&
         static_cast<double>(seen) >= kSeenAgain * static_cast<double>(memory.seen_again.size());
}

StaleVerdict StaleScans::weigh(const KeyframeGraph& graph) {
  StaleVerdict verdict;
  const Keyframe& newest = graph[graph.size() - 1];
  const Box box = box_of(*newest.scan, newest.T_map_base);
  const View view(*newest.scan, newest.T_map_base);
  const std::vector<int> edges = edges_per_keyframe(graph);
  for (const int i : candidates(graph, 0.5 * box.diagonal().norm())) {
    Memory& memory = memory_of(graph, i);
    const PointScan& scan = *memory.scan;
    const Box other = box_of(scan, graph.pose(i));
    const double shared = area(box.intersection(other));
    const double iou = shared / std::max(area(box) + area(other) - shared, 1e-9);
    if (iou < options_.minimum_score) continue;
    auto thinned = std::make_shared<PointScan>();
    thinned->origin = scan.origin;
    std::vector<char> seen_again;
    int seen = 0;
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      const Eigen::Vector2d p = graph.pose(i) * scan.points[k].p.cast<double>();
      const bool is_seen = view.has_seen(p);
      seen += is_seen ? 1 : 0;
      if (is_seen && view.has_seen_through(p)) continue;
      thinned->points.push_back(scan.points[k]);
      seen_again.push_back(is_seen || memory.seen_again[k] != 0 ? 1 : 0);
    }
    const double readings = static_cast<double>(seen) / static_cast<double>(scan.points.size());
    const double overlap =
        options_.overlap_score_scale * std::min(shared / std::max(area(other), 1e-9), readings);
    const double bonus =
        std::clamp(options_.constraint_multiplier * (edges[i] - 2), 0.0, std::min(1.0, overlap));
    memory.score = memory.score * (1.0 + bonus) - overlap - options_.nearby_penalty;
    memory.score = std::min(memory.score, 1.0);
    if (iou > options_.iou_match && edges[i] < 3) memory.score = -1.0;
    memory.seen_again = std::move(seen_again);
    const bool is_thinned = thinned->points.size() < scan.points.size();
    const bool is_stale = is_replaced(memory);
    memory.scan = std::move(thinned);
    if (is_stale || memory.scan->points.empty()) {
      verdict.stale.push_back(i);
    } else if (is_thinned) {
      verdict.thinned.emplace_back(i, memory.scan);
    } else {
      memory.scan = graph[i].scan;
    }
  }
  return verdict;
}

void StaleScans::keep(const std::vector<int>& kept) {
  std::vector<Memory> rest;
  for (const int i : kept) {
    const auto at = static_cast<std::size_t>(i);
    rest.push_back(at < memories_.size() ? std::move(memories_[at]) : Memory{});
  }
  memories_ = std::move(rest);
}

}  // namespace trident::slam
