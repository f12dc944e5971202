// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "trident_slam/pose_graph.h"

namespace trident::slam {

/// Numbers in [-1, 1], the same in every run.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double roll() { return static_cast<double>(engine_()) / 2147483647.5 - 1.0; }
  int roll(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  template <class Vector>
  Vector vector(double scale) {
    Vector v;
    for (int k = 0; k < v.size(); ++k) v[k] = scale * roll();
    return v;
  }

 private:
  std::mt19937 engine_;
};

/// A rectangular grid, driven boustrophedon with measurements to the neighbors in the row before;
/// every measurement is off by up to `noise` [m, rad]. The graph's poses are those of odometry.
template <class Group>
PoseGraph<Group> grid_graph(int rows, int columns, double noise, unsigned seed,
                            std::vector<Group>* truth = nullptr) {
  using Tangent = typename Group::Tangent;
  Dice dice(seed);
  std::vector<Group> true_poses{Group::identity()};
  for (int k = 1; k < rows * columns; ++k) {
    Tangent turn = Tangent::Zero();
    turn[0] = 1.0;
    const int column = k % columns;
    const double quarter = (k / columns) % 2 == 1 ? 1.5707963 : -1.5707963;
    if (column == 0) turn[turn.size() - 1] = -quarter;
    if (column == 1 && k > columns) turn[turn.size() - 1] = quarter;
    if (turn.size() == 6) turn[3] = 0.02 * dice.roll();
    true_poses.push_back(true_poses.back() * Group::exp(turn));
  }
  PoseGraph<Group> graph;
  const auto measured = [&](int from, int to) {
    return true_poses[from].inverse() * true_poses[to] * Group::exp(dice.vector<Tangent>(noise));
  };
  Group T = Group::identity();
  graph.add_vertex(0, T);
  const double information = noise > 0.0 ? 3.0 / (noise * noise) : 100.0;
  typename PoseGraph<Group>::Edge edge;
  edge.information *= information;
  for (int k = 1; k < rows * columns; ++k) {
    edge.from = k - 1;
    edge.to = k;
    edge.T_from_to = measured(k - 1, k);
    edge.is_trusted = true;
    T = T * edge.T_from_to;
    graph.add_vertex(k, T);
    graph.add_edge(edge);
    const int before = k - 1 - 2 * (k % columns);  // next to it, in the row before
    if (before < 0 || before == k - 1) continue;
    edge.from = before;
    edge.T_from_to = measured(before, k);
    edge.is_trusted = false;
    graph.add_edge(edge);
  }
  if (truth != nullptr) *truth = true_poses;
  return graph;
}

}  // namespace trident::slam
