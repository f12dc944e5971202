// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/incremental_pose_graph.h"

#include <algorithm>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

void require(bool is_legal, const char* field, double value, const char* range) {
  if (is_legal) return;
  throw Error("incremental pose graph: " + std::string(field) + " is " + number_text(value) +
              ", but must be " + range);
}

/// Where an edge to or from a vertex puts it.
template <class Group>
Group pose_by(const typename PoseGraph<Group>::Edge& edge, int id, const PoseGraph<Group>& graph) {
  return edge.to == id ? graph.pose(edge.from) * edge.T_from_to
                       : graph.pose(edge.to) * edge.T_from_to.inverse();
}

}  // namespace

void IncrementalOptions::validate() const {
  require(share >= 0.0, "share", share, ">= 0");
  require(least >= 0.0, "least", least, ">= 0");
  require(steps >= 1, "steps", steps, ">= 1");
}

template <class Group>
IncrementalPoseGraph<Group>::IncrementalPoseGraph(const IncrementalOptions& options)
    : options_(options) {
  options_.validate();
}

template <class Group>
void IncrementalPoseGraph<Group>::add(int id, const Group& T_map_vertex,
                                      const std::vector<Edge>& edges) {
  Group T = edges.empty() ? T_map_vertex : pose_by(edges.front(), id, graph_);
  for (const Edge& edge : edges) {
    if (edge.from == last_id_ || edge.to == last_id_) T = pose_by(edge, id, graph_);
  }
  graph_.add_vertex(id, T);
  last_id_ = id;
  for (const Edge& edge : edges) {
    graph_.add_edge(edge);
    const typename Group::Tangent error =
        pose_graph_error(graph_.pose(edge.from), graph_.pose(edge.to), edge.T_from_to);
    pending_ += error.dot(edge.information * error);
  }
  if (pending_ > std::max(options_.least, options_.share * chi2_)) optimize(options_.steps);
}

template <class Group>
void IncrementalPoseGraph<Group>::finish() {
  optimize(PoseGraphOptions().max_iterations);
}

template <class Group>
void IncrementalPoseGraph<Group>::optimize(int iterations) {
  PoseGraphOptions options;
  options.max_iterations = iterations;
  chi2_ = PoseGraphOptimizer<Group>(options).optimize(graph_).chi2_after;
  pending_ = 0.0;
  ++optimizations_;
}

template class IncrementalPoseGraph<SE2>;
template class IncrementalPoseGraph<SE3>;

}  // namespace trident::slam
