// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "map_editor.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace trident::slam {
namespace {

void move_submap(int submap, const SE2& T_map_moved, KeyframeGraph* graph) {
  for (int i = graph->first_of(submap); i < graph->end_of(submap); ++i) {
    graph->set_pose(i, T_map_moved * graph->pose(i));
  }
}

}  // namespace

/// A loop that the user asks for is matched from where the user has put it, and refused if the
/// scans do not fit there.
bool MapEditor::close_loop(int older, int newer, const SE2& T_older_newer,
                           const ScanTrackerOptions& tracking) {
  SurfelMap reference(tracking.tracking.surfel_cell);
  reference.insert(SE2::identity(), *(*graph_)[older].scan);
  const MatchResult match =
      match_lines(reference, *(*graph_)[newer].scan, T_older_newer, {}, tracking.line);
  if (match.inlier_fraction < options_.editing.min_inliers) return false;
  const LoopVerificationOptions& loops = options_.loop_verification;
  GraphEdge edge;
  edge.from = older;
  edge.to = newer;
  edge.T_from_to = match.T_ref_base;
  edge.information =
      Eigen::Vector3d(loops.information, loops.information, loops.information_yaw).asDiagonal();
  edge.kind = EdgeKind::kLoop;
  graph_->add_edge(edge);
  backend_->realign(Realign::kEdges);
  return true;
}

// Nearest first, apart from the keyframe's own submap and its neighbors.
std::vector<int> MapEditor::submaps_near(int own, const Eigen::Vector2d& place) const {
  const double reach = options_.editing.reach;
  std::vector<std::pair<double, int>> found;
  for (int s = 0; s < graph_->submaps(); ++s) {
    if (std::abs(s - own) < 2) continue;
    double nearest = reach;
    for (int i = graph_->first_of(s); i < graph_->end_of(s); ++i) {
      nearest = std::min(nearest, (graph_->pose(i).p - place).norm());
    }
    if (nearest < reach) found.emplace_back(nearest, s);
  }
  std::sort(found.begin(), found.end());
  std::vector<int> submaps;
  submaps.reserve(found.size());
  for (const auto& [distance, s] : found) submaps.push_back(s);
  return submaps;
}

std::optional<GraphEdge> MapEditor::make_edge_at_pose(int keyframe, const SE2& T_map_base) const {
  const int own = graph_->submap_of(keyframe);
  const SE2 T_new_old = T_map_base * graph_->pose(keyframe).inverse();
  for (const int other : submaps_near(own, T_map_base.p)) {
    // The newer of both is the one that is moved: the older one keeps its neighbors.
    KeyframeGraph moved = *graph_;
    move_submap(std::max(own, other), own > other ? T_new_old : T_new_old.inverse(), &moved);
    const auto candidate = backend_->loop_closer().match(
        moved, std::min(own, other), std::max(own, other), options_.editing.path_length);
    if (candidate) return loop_edge(*graph_, *candidate, options_.loop_verification);
  }
  return std::nullopt;
}

/// All edges are added before the graph is optimized once: moves that belong together are not
/// played off against each other.
std::vector<int> MapEditor::move_keyframes(const std::map<int, SE2>& T_map_base) {
  backend_->finish_running_search();
  std::vector<int> rejected;
  std::vector<GraphEdge> edges;
  for (const auto& [keyframe, T] : T_map_base) {
    if (const auto edge = make_edge_at_pose(keyframe, T)) {
      edges.push_back(*edge);
    } else {
      rejected.push_back(keyframe);
    }
  }
  if (edges.empty()) return rejected;
  for (const GraphEdge& edge : edges) graph_->add_edge(edge);
  backend_->reoptimize();
  return rejected;
}

// A submap is one piece of the path: what is joined to the graph begins a new one. Keyframes
// without a scan fill the last one up, fixed to it by edges of next to no uncertainty.
void MapEditor::pad_last_submap() {
  while (graph_->size() % graph_->submap_size() != 0) {
    const int last = graph_->size() - 1;
    const int k = graph_->add({graph_->pose(last), {}, (*graph_)[last].travelled});
    graph_->set_scan(k, std::make_shared<const PointScan>());
    graph_->add_edge({last, k, SE2::identity(), 1e6 * Eigen::Matrix3d::Identity()});
  }
}

/// The other session's keyframes follow those of this one, with numbers moved behind them; submaps
/// do not mix the two. A weak edge ties both, until loops show how they lie.
int MapEditor::join(const KeyframeGraph& other, const SE2& T_map_session, double gap) {
  pad_last_submap();
  const int first = graph_->size();
  for (int i = 0; i < other.size(); ++i) {
    Keyframe keyframe = other[i];
    keyframe.T_map_base = T_map_session * keyframe.T_map_base;
    keyframe.travelled += gap;
    graph_->add(keyframe);
  }
  for (GraphEdge edge : other.edges()) {
    edge.from += first;
    edge.to += first;
    graph_->add_edge(edge);
  }
  if (first > 0 && graph_->size() > first) {
    const double w = options_.editing.join_information;
    GraphEdge edge{first - 1, first, graph_->pose(first - 1).inverse() * graph_->pose(first)};
    edge.information = Eigen::Vector3d(w, w, options_.editing.join_information_yaw).asDiagonal();
    graph_->add_edge(edge);
  }
  return first;
}

}  // namespace trident::slam
