// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/keyframe_graph.h"

#include <Eigen/SparseCholesky>
#include <limits>
#include <queue>
#include <utility>

namespace trident {

int KeyframeGraph::add(const Keyframe& keyframe) {
  keyframes_.push_back(keyframe);
  return size() - 1;
}

std::vector<double> KeyframeGraph::distances_from(int stretch) const {
  const std::size_t count = static_cast<std::size_t>(stretches());
  std::vector<std::vector<std::pair<int, double>>> neighbours(count);
  for (std::size_t s = 1; s < count; ++s) {
    const int at = static_cast<int>(s);
    const double way = (*this)[anchor_of(at)].travelled - (*this)[anchor_of(at - 1)].travelled;
    neighbours[s].emplace_back(at - 1, way);
    neighbours[s - 1].emplace_back(at, way);
  }
  for (const GraphEdge& edge : edges_) {
    if (edge.kind == EdgeKind::kChain) continue;
    neighbours[stretch_of(edge.from)].emplace_back(stretch_of(edge.to), 1.0);
    neighbours[stretch_of(edge.to)].emplace_back(stretch_of(edge.from), 1.0);
  }
  std::vector<double> distances(count, std::numeric_limits<double>::infinity());
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  distances[stretch] = 0.0;
  queue.emplace(0.0, stretch);
  while (!queue.empty()) {
    const auto [distance, at] = queue.top();
    queue.pop();
    if (distance > distances[at]) continue;
    for (const auto& [next, way] : neighbours[at]) {
      if (distance + way >= distances[next]) continue;
      distances[next] = distance + way;
      queue.emplace(distances[next], next);
    }
  }
  return distances;
}

Eigen::Vector3d edge_error(const GraphEdge& edge, const SE2& T_map_from, const SE2& T_map_to) {
  return (edge.T_from_to.inverse() * T_map_from.inverse() * T_map_to).log();
}

void KeyframeGraph::optimize(double kernel, int iterations) {
  const int n = size();
  if (n < 2) return;
  for (int it = 0; it < iterations; ++it) {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(edges_.size() * 27 + 3);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(3 * n);
    auto put = [&](int r, int c, const Eigen::Matrix3d& M) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (3 * r + i >= 3 * c + j) triplets.emplace_back(3 * r + i, 3 * c + j, M(i, j));
    };
    for (const GraphEdge& e : edges_) {
      const SE2 T = pose(e.from).inverse() * pose(e.to);
      const Eigen::Vector3d r = (e.T_from_to.inverse() * T).log();
      double w = 1.0;
      if (e.kind != EdgeKind::kChain)
        w = 1.0 / (1.0 + r.dot(e.information * r) / (kernel * kernel));
      const Eigen::Matrix3d A = -T.inverse().adjoint();
      const Eigen::Matrix3d O = w * e.information;
      put(e.from, e.from, A.transpose() * O * A);
      put(e.to, e.to, O);
      if (e.from > e.to)
        put(e.from, e.to, A.transpose() * O);
      else
        put(e.to, e.from, O * A);
      b.segment<3>(3 * e.from) += A.transpose() * (O * r);
      b.segment<3>(3 * e.to) += O * r;
    }
    for (int i = 0; i < 3; ++i) triplets.emplace_back(i, i, 1e12);
    Eigen::SparseMatrix<double> H(3 * n, 3 * n);
    H.setFromTriplets(triplets.begin(), triplets.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(H);
    const Eigen::VectorXd x = solver.solve(-b);
    for (int i = 0; i < n; ++i) set_pose(i, pose(i) * SE2::exp(x.segment<3>(3 * i)));
    if (x.cwiseAbs().maxCoeff() < 1e-5) break;
  }
}

}  // namespace trident
