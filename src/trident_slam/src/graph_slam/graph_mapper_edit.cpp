// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Maps that a user corrects by hand, and maps that are joined.
#include <algorithm>
#include <cstdlib>

#include "graph_mapper.h"
#include "graph_slam/loop/loop_closer.h"

namespace trident::slam {
namespace {

/// What lies within this of where a keyframe was moved may be what the user means [m].
constexpr double kReach = 3.0;
/// Stands for a window of a metre and ten degrees about where the user put it [m].
constexpr double kWayOfAHand = 20.0;
/// Of what the optimisation doubts [standard deviations].
constexpr double kKernel = 3.0;
constexpr int kIterations = 20;

/// Stretches with a keyframe near a place, nearest first, apart from the one about `own`.
std::vector<int> stretches_near(const KeyframeGraph& graph, int own, const Eigen::Vector2d& place) {
  std::vector<std::pair<double, int>> found;
  for (int s = 0; s < graph.stretches(); ++s) {
    if (std::abs(s - own) < 2) continue;
    double nearest = kReach;
    for (int i = graph.first_of(s); i < graph.end_of(s); ++i) {
      nearest = std::min(nearest, (graph.pose(i).p - place).norm());
    }
    if (nearest < kReach) found.emplace_back(nearest, s);
  }
  std::sort(found.begin(), found.end());
  std::vector<int> stretches;
  stretches.reserve(found.size());
  for (const auto& [distance, s] : found) stretches.push_back(s);
  return stretches;
}

void move_stretch(int stretch, const SE2& T_map_moved, KeyframeGraph* graph) {
  for (int i = graph->first_of(stretch); i < graph->end_of(stretch); ++i) {
    graph->set_pose(i, T_map_moved * graph->pose(i));
  }
}

}  // namespace

void GraphMapper::optimize_anew() {
  worker_.clear();
  final_poses_.clear();
  const SE2 T_newest_base = graph_.pose(graph_.size() - 1).inverse() * tracker_.T_map_base();
  graph_.optimize(kKernel, kIterations);
  rebuild_surfaces();
  tracker_.set_pose(graph_.pose(graph_.size() - 1) * T_newest_base);
  hide_what_drifted();
}

std::optional<GraphEdge> GraphMapper::edge_to_what_lies_at(int keyframe,
                                                           const SE2& T_map_base) const {
  const int own = graph_.stretch_of(keyframe);
  const SE2 T_new_old = T_map_base * graph_.pose(keyframe).inverse();
  for (const int other : stretches_near(graph_, own, T_map_base.p)) {
    // The newer of both is the one that is moved: the older one keeps its neighbours.
    KeyframeGraph moved = graph_;
    move_stretch(std::max(own, other), own > other ? T_new_old : T_new_old.inverse(), &moved);
    LoopCandidate candidate;
    if (!worker_.closer().match(moved, std::min(own, other), std::max(own, other), kWayOfAHand,
                                &candidate)) {
      continue;
    }
    return loop_edge(graph_, candidate);
  }
  return std::nullopt;
}

std::vector<int> GraphMapper::move_keyframes(const std::map<int, SE2>& T_map_base) {
  worker_.wait();
  if (std::optional<LoopOutcome> outcome = worker_.take()) apply(std::move(*outcome));
  std::vector<int> misfits;
  std::vector<GraphEdge> edges;
  for (const auto& [keyframe, T] : T_map_base) {
    if (const auto edge = edge_to_what_lies_at(keyframe, T)) {
      edges.push_back(*edge);
    } else {
      misfits.push_back(keyframe);
    }
  }
  if (edges.empty()) return misfits;
  for (const GraphEdge& edge : edges) graph_.add_edge(edge);
  optimize_anew();
  return misfits;
}

// A stretch is one piece of way: what is joined to the graph begins a new one. Keyframes without a
// scan fill the last one up.
void GraphMapper::begin_stretch() {
  while (graph_.size() % graph_.stretch_size() != 0) {
    const int last = graph_.size() - 1;
    const int k = graph_.add({graph_.pose(last), {}, graph_[last].travelled});
    graph_.forget_scan(k);
    graph_.add_edge({last, k, SE2::identity(), 1e6 * Eigen::Matrix3d::Identity()});
  }
}

int GraphMapper::append(BinaryReader* reader, const SE2& T_map_session) {
  MapperState session{KeyframeGraph(1, graph_.solver()), {}, {}, 0.0};
  session.load(reader);
  worker_.wait();
  if (std::optional<LoopOutcome> outcome = worker_.take()) apply(std::move(*outcome));
  begin_stretch();
  const int first = graph_.size();
  // As if the robot had driven so far unseen that everything may have to be found again.
  const double gap = first > 0 ? travelled_ + options_.reuse_distance + 1.0 : 0.0;
  for (int i = 0; i < session.graph.size(); ++i) {
    Keyframe keyframe = session.graph[i];
    keyframe.T_map_base = T_map_session * keyframe.T_map_base;
    keyframe.travelled += gap;
    graph_.add(keyframe);
  }
  for (GraphEdge edge : session.graph.edges()) {
    edge.from += first;
    edge.to += first;
    graph_.add_edge(edge);
  }
  if (first > 0 && graph_.size() > first) {
    GraphEdge edge{first - 1, first, graph_.pose(first - 1).inverse() * graph_.pose(first)};
    edge.information = Eigen::Vector3d(1.0, 1.0, 100.0).asDiagonal();  // 1 m, 0.1 rad: a guess
    graph_.add_edge(edge);
  }
  archive_.append(session.archive, first, T_map_session);
  travelled_ = gap + session.travelled;
  final_poses_.clear();
  rebuild_surfaces();
  tracker_.hide({});
  set_pose(T_map_session * session.T_map_base);
  return first == 0 ? 0 : close_loops_across(first);
}

int GraphMapper::close_loops_across(int first_newer) {
  for (int s = graph_.stretch_of(first_newer); s < graph_.stretches(); ++s) {
    apply(worker_.search(graph_, s, tracker_.options().surfel_cell));
  }
  return static_cast<int>(std::count_if(
      graph_.edges().begin(), graph_.edges().end(), [first_newer](const GraphEdge& edge) {
        const bool is_across = std::min(edge.from, edge.to) < first_newer &&
                               std::max(edge.from, edge.to) >= first_newer;
        return edge.kind == EdgeKind::kLoop && is_across;
      }));
}

}  // namespace trident::slam
