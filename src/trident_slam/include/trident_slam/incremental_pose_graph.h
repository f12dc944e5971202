// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// When whole optimizations are made, and how far each goes.
struct IncrementalOptions {
  /// The graph is optimised when what was added since disagrees with it by more than this part of
  /// its chi2, >= 0, ...
  double share = 0.2;
  /// ... and by more than this, >= 0.
  double least = 1.0;
  /// Iterations each time, >= 1; the next time continues from there. Where one would raise the
  /// cost, the optimiser's bounded steps lead to the optimum instead.
  int steps = 1;

  /// Throws Error naming field, value and range.
  void validate() const;
};

/// A pose graph that a robot adds to while it drives, a vertex at a time, with poses that are good
/// at any time. A vertex that odometry alone leads to is where that says, which is the optimum. An
/// edge that closes a loop counts by how much the graph disagrees with it: whole optimisations wait
/// until enough has come together, so that each is worth its cost and few are made where the map is
/// known. In between the poses' chi2 is above the least one by no more than what has come together.
template <class Group>
class IncrementalPoseGraph {
 public:
  using Edge = typename PoseGraph<Group>::Edge;

  /// Empty. Throws Error as IncrementalOptions::validate() does.
  explicit IncrementalPoseGraph(const IncrementalOptions& options = {});
  /// What was moved from can only be destroyed or assigned to.
  IncrementalPoseGraph(IncrementalPoseGraph&&) noexcept;
  IncrementalPoseGraph& operator=(IncrementalPoseGraph&&) noexcept;  ///< see above
  ~IncrementalPoseGraph();

  /// A vertex and its edges to vertices that are known; where the last edge from the vertex before
  /// it leads, or else the first edge. Without an edge (the first one) it is where `T_map_vertex`
  /// says. Throws Error as PoseGraph does.
  void add(int id, const Group& T_map_vertex, const std::vector<Edge>& edges);
  /// To the optimum, within the optimiser's tolerance.
  void finish();

  /// With poses that are good now; at their optimum after finish().
  const PoseGraph<Group>& graph() const { return graph_; }
  /// Whole optimisations so far.
  int optimizations() const { return optimizations_; }

 private:
  class Solver;

  Group placed(int id, const Group& T_map_vertex, const std::vector<Edge>& edges) const;
  void optimize();
  void search();  ///< with bounded steps, to the optimum

  IncrementalOptions options_;
  PoseGraph<Group> graph_;
  std::unique_ptr<Solver> solver_;
  double chi2_ = 0.0;     ///< after the last optimisation
  double pending_ = 0.0;  ///< by what was added since
  int last_id_ = 0;
  int optimizations_ = 0;
};

extern template class IncrementalPoseGraph<SE2>;
extern template class IncrementalPoseGraph<SE3>;

}  // namespace trident::slam
