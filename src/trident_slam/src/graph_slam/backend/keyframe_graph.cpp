// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "keyframe_graph.h"

#include <cstdlib>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

int KeyframeGraph::add(const Keyframe& keyframe) {
  keyframes_.push_back(keyframe);
  return size() - 1;
}

/// Dijkstra over submaps: along the path by the distance that was travelled, over any other edge by
/// a metre. How far two submaps may have drifted apart grows with this length.
std::vector<double> KeyframeGraph::distances_from(int submap) const {
  const std::size_t count = static_cast<std::size_t>(submaps());
  std::vector<std::vector<std::pair<int, double>>> neighbors(count);
  for (std::size_t s = 1; s < count; ++s) {
    const int at = static_cast<int>(s);
    const double path_length =
        (*this)[anchor_of(at)].travelled - (*this)[anchor_of(at - 1)].travelled;
    neighbors[s].emplace_back(at - 1, path_length);
    neighbors[s - 1].emplace_back(at, path_length);
  }
  for (const GraphEdge& edge : edges_) {
    if (edge.kind == EdgeKind::kOdometry) continue;
    neighbors[submap_of(edge.from)].emplace_back(submap_of(edge.to), 1.0);
    neighbors[submap_of(edge.to)].emplace_back(submap_of(edge.from), 1.0);
  }
  std::vector<double> distances(count, std::numeric_limits<double>::infinity());
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  distances[submap] = 0.0;
  queue.emplace(0.0, submap);
  while (!queue.empty()) {
    const auto [distance, at] = queue.top();
    queue.pop();
    if (distance > distances[at]) continue;
    for (const auto& [next, path_length] : neighbors[at]) {
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

void KeyframeGraph::forget_scan(int i) {
  keyframes_[static_cast<std::size_t>(i)].scan = std::make_shared<const PointScan>();
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
  const std::vector<GraphEdge> edges = std::exchange(edges_, {});
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (is_removed[i] != 0) continue;
    result.kept.push_back(static_cast<int>(i));
    keyframes_.push_back(before[i]);
  }
  std::size_t next = 0;  // of those that are left, the first one that is not before i
  for (std::size_t i = 0; i < before.size(); ++i) {
    while (next + 1 < result.kept.size() && result.kept[next] < static_cast<int>(i)) ++next;
    const int old = static_cast<int>(i);
    const bool is_last_nearer =
        next > 0 && old - result.kept[next - 1] < std::abs(result.kept[next] - old);
    const std::size_t stand_in = is_last_nearer ? next - 1 : next;
    result.stand_in.push_back(static_cast<int>(stand_in));
    result.T_stand_in_base.push_back(keyframes_[stand_in].T_map_base.inverse() *
                                     before[i].T_map_base);
  }
  std::set<std::pair<int, int>> known;
  // Edges that stay as they are come first: of several between two keyframes one is enough.
  for (const bool is_moved : {false, true}) {
    for (const GraphEdge& edge : edges) {
      const bool has_moved = is_removed[edge.from] != 0 || is_removed[edge.to] != 0;
      if (has_moved != is_moved) continue;
      GraphEdge moved = edge;
      moved.from = result.stand_in[edge.from];
      moved.to = result.stand_in[edge.to];
      if (moved.from == moved.to) continue;
      if (!known.insert(std::minmax(moved.from, moved.to)).second && is_moved) continue;
      const SE2 T_to_moved = result.T_stand_in_base[edge.to].inverse();
      moved.T_from_to = result.T_stand_in_base[edge.from] * edge.T_from_to * T_to_moved;
      const Eigen::Matrix3d J = T_to_moved.adjoint();  // from the new frame to the old one
      const Eigen::Matrix3d information = J.transpose() * edge.information * J;
      moved.information = 0.5 * (information + information.transpose());
      edges_.push_back(moved);
    }
  }
  return result;
}

/// Scans are stored as points with normals, as they are used.
void KeyframeGraph::save(BinaryWriter* writer) const {
  writer->put<std::int32_t>(submap_size_);
  writer->put<std::uint64_t>(keyframes_.size());
  for (const Keyframe& keyframe : keyframes_) {
    writer->put_pose(keyframe.T_map_base);
    writer->put(keyframe.travelled);
    for (const float value : {keyframe.scan->origin.x(), keyframe.scan->origin.y()}) {
      writer->put(value);
    }
    writer->put<std::uint64_t>(keyframe.scan->points.size());
    for (const SurfacePoint& point : keyframe.scan->points) {
      for (const float value : {point.p.x(), point.p.y(), point.normal.x(), point.normal.y()}) {
        writer->put(value);
      }
    }
  }
  writer->put<std::uint64_t>(edges_.size());
  for (const GraphEdge& edge : edges_) {
    writer->put<std::int32_t>(edge.from);
    writer->put<std::int32_t>(edge.to);
    writer->put_pose(edge.T_from_to);
    for (int k = 0; k < 9; ++k) writer->put(edge.information(k / 3, k % 3));
    writer->put<std::uint8_t>(static_cast<std::uint8_t>(edge.kind));
  }
}

/// What a damaged file says of sizes and indices is checked before memory is taken or read.
void KeyframeGraph::load(BinaryReader* reader) {
  submap_size_ = reader->get<std::int32_t>();
  if (submap_size_ < 1) reader->fail();
  keyframes_.resize(reader->get_count(sizeof(double)));
  for (Keyframe& keyframe : keyframes_) {
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
  edges_.resize(reader->get_count(sizeof(double)));
  for (GraphEdge& edge : edges_) {
    edge.from = reader->get<std::int32_t>();
    edge.to = reader->get<std::int32_t>();
    edge.T_from_to = reader->get_pose();
    for (int k = 0; k < 9; ++k) edge.information(k / 3, k % 3) = reader->get<double>();
    edge.kind = static_cast<EdgeKind>(reader->get<std::uint8_t>());
    for (const int end : {edge.from, edge.to}) {
      if (end < 0 || end >= size()) reader->fail();
    }
  }
}

/// The first keyframe is the map's frame and stays. Only edges to revisited places get a robust
/// kernel: those are not verified, as loops are.
void KeyframeGraph::optimize(const GraphOptimizationOptions& options) {
  if (size() < 2) return;
  PoseGraph2d graph;
  for (int i = 0; i < size(); ++i) graph.add_vertex(i, pose(i));
  graph.set_fixed(0, true);
  for (const GraphEdge& edge : edges_) {
    const bool is_unverified = edge.kind == EdgeKind::kRevisit;
    graph.add_edge({edge.from, edge.to, edge.T_from_to, edge.information,
                    is_unverified ? RobustKernel::kCauchy : RobustKernel::kNone, options.kernel,
                    !is_unverified});
  }
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
