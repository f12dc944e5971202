// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/incremental_pose_graph.h"

#include <algorithm>
#include <utility>

#include "pose_graph/block_cholesky.h"
#include "pose_graph/pose_system.h"
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

/// Gauss-Newton steps of a graph that grows. What does not change is kept from one to the next:
/// the measurements, the poses as matrices, the cost of where they are, and the memory.
template <class Group>
class IncrementalPoseGraph<Group>::Solver {
 public:
  /// So many steps; false when one would raise the cost or cannot be found, then the graph's poses
  /// stay. The graph may only have grown since the last time, unless `forget` was called.
  bool improve(PoseGraph<Group>& graph, int steps) {
    system_.extend(graph);
    for (; counted_ < system_.edges().size(); ++counted_) {
      const auto& edge = system_.edges()[counted_];
      const double s = system_.squared_error(edge, system_.poses);
      cost_.chi2 += s;
      cost_.robust += system_.robust_value(edge, s).cost;
    }
    cholesky_.reset(system_.symbolic());
    for (int k = 0; k < steps; ++k) {
      if (!step()) return false;
    }
    system_.store(graph);
    return true;
  }
  /// After poses were changed from outside.
  void forget() {
    system_ = PoseSystem<Group>();
    cost_ = {};
    counted_ = 0;
  }
  double chi2() const { return cost_.chi2; }

 private:
  static constexpr int kDimension = PoseSystem<Group>::kDimension;

  // False when it would raise the cost, by more than roundings do where there is nothing to gain.
  bool step() {
    system_.linearize(system_.poses, H_, g_);
    if (!cholesky_.factorize(H_)) return false;
    newton_ = -g_;
    cholesky_.solve(newton_);
    if (!newton_.allFinite()) return false;
    system_.move(system_.poses, newton_, trial_);
    const auto cost = system_.cost(trial_);
    if (!(cost.robust <= cost_.robust)) {
      const PoseGraphOptions options;
      return -g_.dot(newton_) <=
             options.relative_tolerance * cost_.robust + options.absolute_tolerance;
    }
    cost_ = cost;
    std::swap(system_.poses, trial_);
    return true;
  }

  PoseSystem<Group> system_;
  BlockMatrix<kDimension> H_;
  Eigen::VectorXd g_;
  Eigen::VectorXd newton_;
  BlockCholesky<kDimension> cholesky_;
  typename PoseSystem<Group>::Poses trial_;
  typename PoseSystem<Group>::Cost cost_;  // of the system's poses ...
  std::size_t counted_ = 0;                // ... and this many edges
};

template <class Group>
IncrementalPoseGraph<Group>::IncrementalPoseGraph(const IncrementalOptions& options)
    : options_(options), solver_(std::make_unique<Solver>()) {
  options_.validate();
}

template <class Group>
IncrementalPoseGraph<Group>::IncrementalPoseGraph(IncrementalPoseGraph&&) noexcept = default;
template <class Group>
IncrementalPoseGraph<Group>& IncrementalPoseGraph<Group>::operator=(
    IncrementalPoseGraph&&) noexcept = default;
template <class Group>
IncrementalPoseGraph<Group>::~IncrementalPoseGraph() = default;

// Where a vertex's last edge from the vertex before leads; else its first edge, if it has one.
template <class Group>
Group IncrementalPoseGraph<Group>::placed(int id, const Group& T_map_vertex,
                                          const std::vector<Edge>& edges) const {
  Group T = edges.empty() ? T_map_vertex : pose_by(edges.front(), id, graph_);
  for (const Edge& edge : edges) {
    if (edge.from == last_id_ || edge.to == last_id_) T = pose_by(edge, id, graph_);
  }
  return T;
}

// How far all edges disagree with where the vertex is placed is what has come together until the
// next optimization.
template <class Group>
void IncrementalPoseGraph<Group>::add(int id, const Group& T_map_vertex,
                                      const std::vector<Edge>& edges) {
  graph_.add_vertex(id, placed(id, T_map_vertex, edges));
  last_id_ = id;
  for (const Edge& edge : edges) {
    graph_.add_edge(edge);
    const typename Group::Tangent error =
        pose_graph_error(graph_.pose(edge.from), graph_.pose(edge.to), edge.T_from_to);
    pending_ += error.dot(edge.information * error);
  }
  if (pending_ > std::max(options_.least, options_.share * chi2_)) optimize();
}

template <class Group>
void IncrementalPoseGraph<Group>::finish() {
  search();
  pending_ = 0.0;
  ++optimizations_;
}

// A full step may overshoot where a loop bends the graph far: bounded steps take over then.
template <class Group>
void IncrementalPoseGraph<Group>::optimize() {
  if (solver_->improve(graph_, options_.steps)) {
    chi2_ = solver_->chi2();
  } else {
    search();
  }
  pending_ = 0.0;
  ++optimizations_;
}

template <class Group>
void IncrementalPoseGraph<Group>::search() {
  chi2_ = PoseGraphOptimizer<Group>().optimize(graph_).chi2_after;
  solver_->forget();
}

template class IncrementalPoseGraph<SE2>;
template class IncrementalPoseGraph<SE3>;

}  // namespace trident::slam
