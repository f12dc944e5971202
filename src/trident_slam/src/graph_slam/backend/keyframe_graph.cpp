// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "keyframe_graph.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {
namespace {

/// A submap that can be reached, and how far away it is [m].
using Step = std::pair<int, double>;

/// Along the path a step is as long as the path that was driven; an edge that was matched is a
/// short one, as it has no drift to speak of.
std::vector<std::vector<Step>> steps_between_submaps(const KeyframeGraph& graph) {
  std::vector<std::vector<Step>> steps(static_cast<std::size_t>(graph.submaps()));
  for (std::size_t s = 1; s < steps.size(); ++s) {
    const int at = static_cast<int>(s);
    const double path_length =
        graph[graph.anchor_of(at)].travelled - graph[graph.anchor_of(at - 1)].travelled;
    steps[s].emplace_back(at - 1, path_length);
    steps[s - 1].emplace_back(at, path_length);
  }
  for (const GraphEdge& edge : graph.edges()) {
    if (edge.kind == EdgeKind::kOdometry) continue;
    steps[graph.submap_of(edge.from)].emplace_back(graph.submap_of(edge.to), 1.0);
    steps[graph.submap_of(edge.to)].emplace_back(graph.submap_of(edge.from), 1.0);
  }
  return steps;
}

/// Of each keyframe the one next to it along the path that is left.
void choose_stand_ins(const std::vector<Keyframe>& before, KeyframeGraph::Removal& removal) {
  std::size_t next = 0;  // of those that are left, the first one that is not before i
  for (std::size_t i = 0; i < before.size(); ++i) {
    while (next + 1 < removal.kept.size() && removal.kept[next] < static_cast<int>(i)) ++next;
    const int old = static_cast<int>(i);
    const bool is_last_nearer =
        next > 0 && old - removal.kept[next - 1] < std::abs(removal.kept[next] - old);
    const std::size_t stand_in = is_last_nearer ? next - 1 : next;
    removal.stand_in.push_back(static_cast<int>(stand_in));
    removal.T_stand_in_base.push_back(before[removal.kept[stand_in]].T_map_base.inverse() *
                                      before[i].T_map_base);
  }
}

bool touches_removed(const GraphEdge& edge, const std::vector<char>& is_removed) {
  return is_removed[edge.from] != 0 || is_removed[edge.to] != 0;
}

/// The edge between the stand-ins of its keyframes.
GraphEdge moved_to_stand_ins(const GraphEdge& edge, const KeyframeGraph::Removal& removal) {
  GraphEdge moved = edge;
  moved.from = removal.stand_in[edge.from];
  moved.to = removal.stand_in[edge.to];
  const SE2 T_to_moved = removal.T_stand_in_base[edge.to].inverse();
  moved.T_from_to = removal.T_stand_in_base[edge.from] * edge.T_from_to * T_to_moved;
  const Eigen::Matrix3d J = T_to_moved.adjoint();  // from the new frame to the old one
  const Eigen::Matrix3d information = J.transpose() * edge.information * J;
  moved.information = 0.5 * (information + information.transpose());
  return moved;
}

void put(const Keyframe& keyframe, BinaryWriter* writer) {
  writer->put_pose(keyframe.T_map_base);
  writer->put(keyframe.travelled);
  const PointScan& scan = *keyframe.scan;
  for (const float value : {scan.origin.x(), scan.origin.y()}) writer->put(value);
  writer->put<std::uint64_t>(scan.points.size());
  for (const SurfacePoint& point : scan.points) {
    for (const float value : {point.p.x(), point.p.y(), point.normal.x(), point.normal.y()}) {
      writer->put(value);
    }
  }
}

void put(const GraphEdge& edge, BinaryWriter* writer) {
  writer->put<std::int32_t>(edge.from);
  writer->put<std::int32_t>(edge.to);
  writer->put_pose(edge.T_from_to);
  for (int k = 0; k < 9; ++k) writer->put(edge.information(k / 3, k % 3));
  writer->put<std::uint8_t>(static_cast<std::uint8_t>(edge.kind));
}

void get(BinaryReader* reader, Keyframe& keyframe) {
  keyframe.T_map_base = reader->get_pose();
  keyframe.travelled = reader->get<double>();
  auto scan = std::make_shared<PointScan>();
  for (float* value : {&scan->origin.x(), &scan->origin.y()}) *value = reader->get<float>();
  scan->points.resize(reader->get_count(sizeof(SurfacePoint)));
  for (SurfacePoint& point : scan->points) {
    for (float* value : {&point.p.x(), &point.p.y(), &point.normal.x(), &point.normal.y()}) {
      *value = reader->get<float>();
    }
  }
  keyframe.scan = std::move(scan);
}

/// Between two of `keyframes` keyframes.
void get(BinaryReader* reader, int keyframes, GraphEdge& edge) {
  edge.from = reader->get<std::int32_t>();
  edge.to = reader->get<std::int32_t>();
  edge.T_from_to = reader->get_pose();
  for (int k = 0; k < 9; ++k) edge.information(k / 3, k % 3) = reader->get<double>();
  edge.kind = static_cast<EdgeKind>(reader->get<std::uint8_t>());
  for (const int end : {edge.from, edge.to}) {
    if (end < 0 || end >= keyframes) reader->fail();
  }
}

/// Loops have been verified before they are edges; kRevisit edges have not.
PoseGraph2d pose_graph_of(const KeyframeGraph& graph, double kernel_scale) {
  PoseGraph2d result;
  for (int i = 0; i < graph.size(); ++i) result.add_vertex(i, graph.pose(i));
  result.set_fixed(0, true);
  for (const GraphEdge& edge : graph.edges()) {
    const bool is_unverified = edge.kind == EdgeKind::kRevisit;
    result.add_edge({edge.from, edge.to, edge.T_from_to, edge.information,
                     is_unverified ? RobustKernel::kCauchy : RobustKernel::kNone, kernel_scale,
                     !is_unverified});
  }
  return result;
}

}  // namespace

int KeyframeGraph::add(const Keyframe& keyframe) {
  keyframes_.push_back(keyframe);
  return size() - 1;
}

/// Dijkstra over submaps: along the path by the distance that was travelled, over any other edge by
/// a metre. How far two submaps may have drifted apart grows with this length.
std::vector<double> KeyframeGraph::distances_from(int submap) const {
  const std::vector<std::vector<Step>> steps = steps_between_submaps(*this);
  std::vector<double> distances(steps.size(), std::numeric_limits<double>::infinity());
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  distances[submap] = 0.0;
  queue.emplace(0.0, submap);
  while (!queue.empty()) {
    const auto [distance, at] = queue.top();
    queue.pop();
    if (distance > distances[at]) continue;
    for (const auto& [next, path_length] : steps[at]) {
      if (distance + path_length >= distances[next]) continue;
      distances[next] = distance + path_length;
      queue.emplace(distances[next], next);
    }
  }
  return distances;
}

Eigen::Vector3d edge_error(const GraphEdge& edge, const SE2& T_map_from, const SE2& T_map_to) {
  return (edge.T_from_to.inverse() * T_map_from.inverse() * T_map_to).log();
}

Eigen::Matrix3d sigma_information(double sigma, double sigma_yaw) {
  const double w = 1.0 / (sigma * sigma);
  return Eigen::Vector3d(w, w, 1.0 / (sigma_yaw * sigma_yaw)).asDiagonal();
}

void KeyframeGraph::set_scan(int i, std::shared_ptr<const PointScan> scan) {
  keyframes_[static_cast<std::size_t>(i)].scan = std::move(scan);
}

/// Edges of a removed keyframe are tied to the nearest one that stays, by their distance in time:
/// the graph stays connected, and the information moves along by the adjoint of the transform
/// between both.
KeyframeGraph::Removal KeyframeGraph::remove(const std::vector<char>& is_removed) {
  Removal result;
  const std::vector<Keyframe> before = std::exchange(keyframes_, {});
  std::vector<GraphEdge> edges = std::exchange(edges_, {});
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (is_removed[i] != 0) continue;
    result.kept.push_back(static_cast<int>(i));
    keyframes_.push_back(before[i]);
  }
  choose_stand_ins(before, result);
  const auto is_moved = [&](const GraphEdge& edge) { return touches_removed(edge, is_removed); };
  // Edges that stay as they are come first: of several between two keyframes one is enough.
  std::stable_partition(edges.begin(), edges.end(), std::not_fn(is_moved));
  std::set<std::pair<int, int>> known;
  for (const GraphEdge& edge : edges) {
    const GraphEdge moved = moved_to_stand_ins(edge, result);
    if (moved.from == moved.to) continue;
    if (!known.insert(std::minmax(moved.from, moved.to)).second && is_moved(edge)) continue;
    edges_.push_back(moved);
  }
  return result;
}

/// Scans are stored as points with normals, as they are used.
void KeyframeGraph::save(BinaryWriter* writer) const {
  writer->put<std::int32_t>(submap_size_);
  writer->put<std::uint64_t>(keyframes_.size());
  for (const Keyframe& keyframe : keyframes_) put(keyframe, writer);
  writer->put<std::uint64_t>(edges_.size());
  for (const GraphEdge& edge : edges_) put(edge, writer);
}

/// What a damaged file says of sizes and indices is checked before memory is taken or read.
void KeyframeGraph::load(BinaryReader* reader) {
  submap_size_ = reader->get<std::int32_t>();
  if (submap_size_ < 1) reader->fail();
  keyframes_.resize(reader->get_count(sizeof(double)));
  for (Keyframe& keyframe : keyframes_) get(reader, keyframe);
  edges_.resize(reader->get_count(sizeof(double)));
  for (GraphEdge& edge : edges_) get(reader, size(), edge);
}

/// The first keyframe is the map's frame and stays. Only edges to revisited places get a robust
/// kernel: those are not verified, as loops are.
void KeyframeGraph::optimize(const GraphOptimizationOptions& options) {
  if (size() < 2) return;
  PoseGraph2d graph = pose_graph_of(*this, options.kernel);
  if (solver_) {
    solver_(options.max_iterations)->optimize(graph);
  } else {
    PoseGraphOptions limits;
    limits.max_iterations = options.max_iterations;
    PoseGraphOptimizer<SE2>(limits).optimize(graph);
  }
  for (int i = 0; i < size(); ++i) set_pose(i, graph.pose(i));
}

}  // namespace trident::slam
