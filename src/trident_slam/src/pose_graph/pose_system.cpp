// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "pose_system.h"

#include <algorithm>
#include <numeric>

namespace trident::slam {
namespace {

// Which of several things are connected; the representative is the first of them.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

/// By vertex: whether a fixed vertex is of the part that it stands for.
template <class Vertices>
std::vector<bool> anchored_parts(const Vertices& vertices, DisjointSets& parts) {
  std::vector<bool> is_anchored(vertices.size(), false);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (vertices[k].is_fixed) is_anchored[parts.find(static_cast<int>(k))] = true;
  }
  return is_anchored;
}

}  // namespace

// A connected part without a fixed vertex has a gauge freedom that makes the system singular: its
// first vertex is held.
template <class Group>
void PoseSystem<Group>::choose_unknowns(const PoseGraph<Group>& graph) {
  const auto& vertices = graph.vertices();
  DisjointSets parts(vertices.size());
  for (const Edge& edge : edges_) parts.join(edge.from, edge.to);
  const std::vector<bool> is_anchored = anchored_parts(vertices, parts);
  unknown_of_vertex_.assign(vertices.size(), -1);
  vertex_of_unknown_.clear();
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const int part = parts.find(static_cast<int>(k));
    const bool is_anchor = !is_anchored[part] && part == static_cast<int>(k);
    if (vertices[k].is_fixed || is_anchor) continue;
    unknown_of_vertex_[k] = unknowns();
    vertex_of_unknown_.push_back(static_cast<int>(k));
  }
}

// Measurements and weights; the structure stays.
template <class Group>
void PoseSystem<Group>::take(const typename PoseGraph<Group>::Edge& edge, Edge& to) {
  to.measured = Model::from_group(edge.T_from_to);
  to.inverse_measured = to.measured.inverse();
  to.information = edge.information;
  to.kernel = edge.kernel;
  to.kernel_scale = edge.kernel_scale;
  to.is_trusted = edge.is_trusted;
  to.is_rejected = false;
}

// Those of the graph that are not known yet.
template <class Group>
void PoseSystem<Group>::add_edges(const PoseGraph<Group>& graph) {
  for (std::size_t k = edges_.size(); k < graph.edges().size(); ++k) {
    const auto& edge = graph.edges()[k];
    Edge added;
    added.from = static_cast<int>(graph.index(edge.from));
    added.to = static_cast<int>(graph.index(edge.to));
    take(edge, added);
    edges_.push_back(added);
  }
}

// Several edges between two vertices share one block of the Hessian.
template <class Group>
void PoseSystem<Group>::add_pair(Edge& edge) {
  const int from = unknown_of_vertex_[edge.from];
  const int to = unknown_of_vertex_[edge.to];
  if (from == -1 || to == -1) return;
  const auto [first, last] = std::minmax(from, to);
  const std::uint64_t key = (static_cast<std::uint64_t>(first) << 32) + last;
  const auto [found, is_new] = pair_of_.try_emplace(key, static_cast<int>(pairs_.size()));
  if (is_new) pairs_.emplace_back(from, to);
  edge.pair = found->second;
  edge.is_pair_reversed = pairs_[edge.pair].first != from;
}

template <class Group>
void PoseSystem<Group>::build_structure(const PoseGraph<Group>& graph) {
  edges_.clear();
  edges_.reserve(graph.edges().size());
  add_edges(graph);
  choose_unknowns(graph);
  pairs_.clear();
  pair_of_.clear();
  for (Edge& edge : edges_) add_pair(edge);
  symbolic_ = std::make_shared<const BlockSymbolic>(unknowns(), pairs_);
  structure_version_ = graph.structure_version();
}

// The elimination order is the costly part of the structure and depends on it alone: while no
// vertex or edge comes or goes, only numbers are taken over.
template <class Group>
void PoseSystem<Group>::load(const PoseGraph<Group>& graph) {
  if (symbolic_ == nullptr || structure_version_ != graph.structure_version()) {
    build_structure(graph);
  } else {
    for (std::size_t k = 0; k < edges_.size(); ++k) take(graph.edges()[k], edges_[k]);
  }
  poses.clear();
  for (const auto& vertex : graph.vertices()) {
    poses.push_back(Model::from_group(vertex.T_map_vertex));
  }
}

// Are the vertices one connected part, whose held vertex stays the first, and every added one free?
template <class Group>
bool PoseSystem<Group>::is_extendable(const PoseGraph<Group>& graph) const {
  if (symbolic_ == nullptr || vertex_of_unknown_.size() + 1 != unknown_of_vertex_.size()) {
    return false;
  }
  std::vector<bool> is_joined(graph.vertices().size() - poses.size(), false);
  for (std::size_t k = poses.size(); k < graph.vertices().size(); ++k) {
    if (graph.vertices()[k].is_fixed) return false;
  }
  for (std::size_t k = edges_.size(); k < graph.edges().size(); ++k) {
    const auto& edge = graph.edges()[k];
    const std::size_t later = std::max(graph.index(edge.from), graph.index(edge.to));
    if (later >= poses.size()) is_joined[later - poses.size()] = true;
  }
  return std::all_of(is_joined.begin(), is_joined.end(), [](bool is) { return is; });
}

template <class Group>
void PoseSystem<Group>::extend(const PoseGraph<Group>& graph) {
  if (!is_extendable(graph)) {
    load(graph);
    return;
  }
  for (std::size_t k = poses.size(); k < graph.vertices().size(); ++k) {
    unknown_of_vertex_.push_back(unknowns());
    vertex_of_unknown_.push_back(static_cast<int>(k));
    poses.push_back(Model::from_group(graph.vertices()[k].T_map_vertex));
  }
  const std::size_t known = edges_.size();
  add_edges(graph);
  for (std::size_t k = known; k < edges_.size(); ++k) add_pair(edges_[k]);
  symbolic_ = std::make_shared<const BlockSymbolic>(unknowns(), pairs_);
  structure_version_ = graph.structure_version();
}

template <class Group>
void PoseSystem<Group>::store(PoseGraph<Group>& graph) const {
  for (const int vertex : vertex_of_unknown_) {
    graph.set_pose_at(vertex, Model::to_group(poses[vertex]));
  }
}

template <class Group>
double PoseSystem<Group>::squared_error(const Edge& edge, const Poses& at) const {
  const Tangent error = Model::log(edge.inverse_measured * (at[edge.from].inverse() * at[edge.to]));
  return error.dot(edge.information * error);
}

// A rejected edge costs what an outlier costs at most under Geman and McClure's kernel, so that
// costs before and after compare.
template <class Group>
RobustValue PoseSystem<Group>::robust_value(const Edge& edge, double squared_error) {
  if (edge.is_rejected) return {edge.kernel_scale * edge.kernel_scale, 0.0};
  return evaluate_robust_kernel(edge.kernel, edge.kernel_scale, squared_error);
}

template <class Group>
typename PoseSystem<Group>::Cost PoseSystem<Group>::cost(const Poses& at) const {
  Cost cost;
  for (const Edge& edge : edges_) {
    const double s = squared_error(edge, at);
    cost.chi2 += s;
    cost.robust += robust_value(edge, s).cost;
  }
  return cost;
}

// Gauss-Newton with the weight of the robust kernel (iteratively reweighted least squares): H += J'
// w Omega J, g += J' w Omega e. The Jacobian by the pose `from` is that by `to` times minus the
// adjoint of T_to_from, so that one logarithm's Jacobian serves both.
template <class Group>
void PoseSystem<Group>::add_edge_terms(const Edge& edge, const Poses& at,
                                       BlockMatrix<kDimension>& H, Eigen::VectorXd& g) const {
  const Pose T = at[edge.from].inverse() * at[edge.to];
  Matrix J;
  const Tangent error = Model::log(edge.inverse_measured * T, J);
  const Tangent weighted_error = edge.information * error;
  const double weight = robust_value(edge, error.dot(weighted_error)).weight;
  const Tangent g_to = weight * (J.transpose() * weighted_error);
  const Matrix WJ = weight * (edge.information * J);
  const Matrix H_to = J.transpose() * WJ;
  const int from = unknown_of_vertex_[edge.from];
  const int to = unknown_of_vertex_[edge.to];
  if (to != -1) {
    H.diagonal[to] += H_to;
    g.template segment<kDimension>(kDimension * to) += g_to;
  }
  if (from == -1) return;
  const Matrix adjoint = Model::inverse_adjoint(T);
  const Matrix H_from_to = adjoint.transpose() * H_to;  // less its sign
  H.diagonal[from] += H_from_to * adjoint;
  g.template segment<kDimension>(kDimension * from) -= adjoint.transpose() * g_to;
  if (to == -1) return;
  if (edge.is_pair_reversed) {
    H.pairs[edge.pair] -= H_from_to.transpose();
  } else {
    H.pairs[edge.pair] -= H_from_to;
  }
}

template <class Group>
void PoseSystem<Group>::linearize(const Poses& at, BlockMatrix<kDimension>& H,
                                  Eigen::VectorXd& g) const {
  H.set_zero(unknowns(), pairs_.size());
  g.setZero(kDimension * unknowns());
  for (const Edge& edge : edges_) add_edge_terms(edge, at, H, g);
}

// Steps are tangents on the right: T_map_vertex * exp(step).
template <class Group>
void PoseSystem<Group>::move(const Poses& from, const Eigen::VectorXd& step, Poses& to) const {
  to = from;
  for (int k = 0; k < unknowns(); ++k) {
    const int vertex = vertex_of_unknown_[k];
    to[vertex] = Model::moved(from[vertex], step.template segment<kDimension>(kDimension * k));
  }
}

template <class Group>
void begin_report(const PoseSystem<Group>& system, PoseGraphReport& report) {
  const auto before = system.cost(system.poses);
  report.chi2_before = report.chi2_start = before.chi2;
  report.cost_before = before.robust;
}

template <class Group>
void end_report(const PoseSystem<Group>& system, PoseGraphReport& report) {
  const auto after = system.cost(system.poses);
  report.chi2_after = after.chi2;
  report.cost_after = after.robust;
  for (const auto& edge : system.edges()) {
    const double s = system.squared_error(edge, system.poses);
    report.weights.push_back(system.robust_value(edge, s).weight);
  }
}

template void begin_report(const PoseSystem<SE2>&, PoseGraphReport&);
template void begin_report(const PoseSystem<SE3>&, PoseGraphReport&);
template void end_report(const PoseSystem<SE2>&, PoseGraphReport&);
template void end_report(const PoseSystem<SE3>&, PoseGraphReport&);
template class PoseSystem<SE2>;
template class PoseSystem<SE3>;

}  // namespace trident::slam
