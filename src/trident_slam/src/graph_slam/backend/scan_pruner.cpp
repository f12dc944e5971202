// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_pruner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

/// Resolution of what a scan shows to be free: one degree.
constexpr int kViewDirections = 360;
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

/// Keyframes that edges connect with the newest one without leaving those that are near.
std::vector<char> linked_within(const KeyframeGraph& graph, const std::vector<char>& is_near) {
  std::vector<char> is_linked(is_near.size());
  is_linked.back() = 1;
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    for (const GraphEdge& edge : graph.edges()) {
      const bool is_inside = is_near[edge.from] != 0 && is_near[edge.to] != 0;
      if (is_linked[edge.from] == is_linked[edge.to] || !is_inside) continue;
      is_linked[edge.from] = is_linked[edge.to] = 1;
      has_grown = true;
    }
  }
  return is_linked;
}

}  // namespace

/// How much the bounding boxes of the newest scan and an older one share.
struct ScanPruner::Overlap {
  double iou = 0.0;       ///< intersection over union
  double of_older = 0.0;  ///< intersection over the older scan's box
};

ScanPruner::Overlap ScanPruner::overlap_of(const Eigen::AlignedBox2d& newest,
                                           const Eigen::AlignedBox2d& older) {
  const double shared = area(newest.intersection(older));
  return {shared / std::max(area(newest) + area(older) - shared, 1e-9),
          shared / std::max(area(older), 1e-9)};
}

/// What one scan hit, by direction.
class ScanPruner::View {
 public:
  View(const PointScan& scan, const SE2& T_map_base, const FreeSpaceOptions& options)
      : options_(options),
        T_view_map_((T_map_base * SE2::from_xy_yaw(static_cast<double>(scan.origin.x()),
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

  /// Hit again, or seen through.
  bool has_seen(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d p = T_view_map_ * p_map;
    const double range_hit = farthest_[direction_of(p)];
    return range_hit > 0.0 && p.norm() < range_hit + margin(range_hit);
  }
  bool has_seen_through(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d p = T_view_map_ * p_map;
    const std::size_t d = direction_of(p);
    double range_hit = std::numeric_limits<double>::infinity();
    for (const std::size_t offset : {kViewDirections - 1, 0, 1}) {
      const std::size_t i = (d + offset) % kViewDirections;
      if (farthest_[i] <= 0.0) return false;
      range_hit = std::min(range_hit, nearest_[i]);
    }
    return p.norm() < range_hit - margin(range_hit);
  }

 private:
  double margin(double range) const { return options_.margin + options_.margin_per_meter * range; }
  static std::size_t direction_of(const Eigen::Vector2d& p) {
    const auto d =
        static_cast<int>((std::atan2(p.y(), p.x()) + kPi) * (kViewDirections / (2.0 * kPi)));
    return static_cast<std::size_t>(std::clamp(d, 0, kViewDirections - 1));
  }

  FreeSpaceOptions options_;
  SE2 T_view_map_;
  std::array<double, kViewDirections> nearest_{};
  std::array<double, kViewDirections> farthest_{};
};

std::vector<char> ScanPruner::near_newest(const KeyframeGraph& graph, double radius) {
  const int newest = graph.size() - 1;
  std::vector<char> is_near(static_cast<std::size_t>(graph.size()));
  for (int i = 0; i <= newest; ++i) {
    is_near[i] = (graph.pose(i).p - graph.pose(newest).p).norm() < radius ? 1 : 0;
  }
  return is_near;
}

/// Older keyframes within `radius` [m] of the newest one: all, or those that edges lead to without
/// leaving the circle.
std::vector<int> ScanPruner::candidates(const KeyframeGraph& graph, double radius) const {
  const int newest = graph.size() - 1;
  std::vector<char> is_near = near_newest(graph, radius);
  if (!options_.search_use_tree) is_near = linked_within(graph, is_near);
  std::vector<int> result;
  for (int i = 0; i < newest; ++i) {
    const bool is_old = graph[newest].travelled - graph[i].travelled > pruning_.min_path;
    if (is_near[i] != 0 && is_old && !graph[i].scan->points.empty()) result.push_back(i);
  }
  return result;
}

ScanPruner::Memory& ScanPruner::memory_of(const KeyframeGraph& graph, int keyframe) {
  const auto i = static_cast<std::size_t>(keyframe);
  if (memories_.size() <= i) memories_.resize(static_cast<std::size_t>(graph.size()));
  Memory& memory = memories_[i];
  if (memory.scan != graph[keyframe].scan) {
    memory.scan = graph[keyframe].scan;
    memory.seen_again.assign(memory.scan->points.size(), 0);
  }
  return memory;
}

bool ScanPruner::is_replaced(const Memory& memory) const {
  const auto seen = std::count(memory.seen_again.begin(), memory.seen_again.end(), 1);
  return memory.score < options_.node_removal_score &&
         static_cast<double>(seen) >=
             pruning_.min_seen * static_cast<double>(memory.seen_again.size());
}

// Points that the newest scan has seen through are left out of the thinned copy, and those that it
// has seen at all are remembered.
ScanPruner::Comparison ScanPruner::compare(const View& newest, const Memory& memory,
                                           const SE2& T_map_base) {
  Comparison result;
  const PointScan& scan = *memory.scan;
  result.thinned = std::make_shared<PointScan>();
  result.thinned->origin = scan.origin;
  for (std::size_t k = 0; k < scan.points.size(); ++k) {
    const Eigen::Vector2d p = T_map_base * scan.points[k].p.cast<double>();
    const bool is_seen = newest.has_seen(p);
    result.seen += is_seen ? 1 : 0;
    if (is_seen && newest.has_seen_through(p)) continue;
    result.thinned->points.push_back(scan.points[k]);
    result.seen_again.push_back(is_seen || memory.seen_again[k] != 0 ? 1 : 0);
  }
  return result;
}

// The score of slam_toolbox' lifelong mode: a newer scan takes what both share from it, and edges
// beyond two return a part.
void ScanPruner::update_score(const Overlap& overlap, double readings, int edges,
                              Memory* memory) const {
  const double shared = options_.overlap_score_scale * std::min(overlap.of_older, readings);
  const double bonus =
      std::clamp(options_.constraint_multiplier * (edges - 2), 0.0, std::min(1.0, shared));
  memory->score = memory->score * (1.0 + bonus) - shared - options_.nearby_penalty;
  memory->score = std::min(memory->score, 1.0);
  if (overlap.iou > options_.iou_match && edges < 3) memory->score = -1.0;
}

PruneResult ScanPruner::update(const KeyframeGraph& graph) {
  PruneResult result;
  const Keyframe& newest = graph[graph.size() - 1];
  const Box box = box_of(*newest.scan, newest.T_map_base);
  const View view(*newest.scan, newest.T_map_base, free_space_);
  const std::vector<int> edges = edges_per_keyframe(graph);
  for (const int i : candidates(graph, 0.5 * box.diagonal().norm())) {
    // 1. Overlap: only scans whose bounding boxes share enough are compared.
    Memory& memory = memory_of(graph, i);
    const Overlap overlap = overlap_of(box, box_of(*memory.scan, graph.pose(i)));
    if (overlap.iou < options_.minimum_score) continue;
    // 2. Compare: which of the older scan's points has the newest one seen, or seen through?
    const std::size_t count = memory.scan->points.size();
    Comparison comparison = compare(view, memory, graph.pose(i));
    // 3. Score: what both share is taken from the older scan's score.
    update_score(overlap, static_cast<double>(comparison.seen) / static_cast<double>(count),
                 edges[i], &memory);
    // 4. Decide: the scan is removed, thinned or kept.
    memory.seen_again = std::move(comparison.seen_again);
    const bool is_thinned = comparison.thinned->points.size() < count;
    const bool is_stale = is_replaced(memory);
    memory.scan = std::move(comparison.thinned);
    if (is_stale || memory.scan->points.empty()) {
      result.replaced.push_back(i);
    } else if (is_thinned) {
      result.thinned.emplace_back(i, memory.scan);
    } else {
      memory.scan = graph[i].scan;
    }
  }
  return result;
}

void ScanPruner::keep(const std::vector<int>& kept) {
  std::vector<Memory> rest;
  for (const int i : kept) {
    const auto at = static_cast<std::size_t>(i);
    rest.push_back(at < memories_.size() ? std::move(memories_[at]) : Memory{});
  }
  memories_ = std::move(rest);
}

}  // namespace trident::slam
