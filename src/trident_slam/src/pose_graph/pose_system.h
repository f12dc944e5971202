// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "block_cholesky.h"
#include "block_symbolic.h"
#include "edge_model.h"
#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// The least-squares problem of a pose graph: which vertices are unknown, their poses now, the
/// measurements, and the normal equations H step = -g, where H and g add up J' W J and J' W e.
template <class Group>
class PoseSystem {
 public:
  using Model = EdgeModel<Group>;
  using Pose = typename Model::Pose;
  using Tangent = typename Model::Tangent;
  using Matrix = typename Model::Matrix;
  using Poses = std::vector<Pose, Eigen::aligned_allocator<Pose>>;
  static constexpr int kDimension = PoseGraph<Group>::kDimension;

  struct Edge {
    EIGEN_MAKE_ALIGNED_OPERATOR_NEW
    int from = 0;  ///< index of the vertex
    int to = 0;
    int pair = -1;  ///< of two unknown vertices
    bool is_pair_reversed = false;
    bool is_trusted = false;
    bool is_rejected = false;  ///< counts as kernel_scale^2 whatever its error
    RobustKernel kernel = RobustKernel::kNone;
    double kernel_scale = 1.0;
    Pose measured;
    Pose inverse_measured;
    Matrix information = Matrix::Identity();
  };
  struct Cost {
    double chi2 = 0.0;    ///< without kernels
    double robust = 0.0;  ///< with them
  };

  /// Takes measurements and poses; keeps the ordering when the structure is the one it knows.
  void load(const PoseGraph<Group>& graph);
  /// The same for a graph to which vertices and edges were added and that is otherwise as this
  /// system has loaded or stored it: only what was added is taken. Gives what load() gives.
  void extend(const PoseGraph<Group>& graph);
  /// Writes the poses of unknown vertices.
  void store(PoseGraph<Group>& graph) const;

  Cost cost(const Poses& poses) const;
  /// H and g (of the unknowns, in their order) at these poses.
  void linearize(const Poses& poses, BlockMatrix<kDimension>& H, Eigen::VectorXd& g) const;
  /// The poses after a step of the unknowns.
  void move(const Poses& from, const Eigen::VectorXd& step, Poses& to) const;

  int unknowns() const { return static_cast<int>(vertex_of_unknown_.size()); }
  int unknown(std::size_t vertex) const { return unknown_of_vertex_[vertex]; }  ///< -1: held
  int vertex(int unknown) const { return vertex_of_unknown_[unknown]; }
  const std::vector<std::pair<int, int>>& pairs() const { return pairs_; }
  const std::shared_ptr<const BlockSymbolic>& symbolic() const { return symbolic_; }
  const std::vector<Edge, Eigen::aligned_allocator<Edge>>& edges() const { return edges_; }
  std::vector<Edge, Eigen::aligned_allocator<Edge>>& edges() { return edges_; }
  double squared_error(const Edge& edge, const Poses& poses) const;
  static RobustValue robust_value(const Edge& edge, double squared_error);

  Poses poses;

 private:
  void build_structure(const PoseGraph<Group>& graph);
  void choose_unknowns(const PoseGraph<Group>& graph);
  bool is_extendable(const PoseGraph<Group>& graph) const;
  void add_edges(const PoseGraph<Group>& graph);
  void add_pair(Edge& edge);
  static void take(const typename PoseGraph<Group>::Edge& edge, Edge& to);
  void add_edge_terms(const Edge& edge, const Poses& poses, BlockMatrix<kDimension>& H,
                      Eigen::VectorXd& g) const;

  std::size_t structure_version_ = 0;
  std::vector<int> unknown_of_vertex_;
  std::vector<int> vertex_of_unknown_;
  std::vector<std::pair<int, int>> pairs_;
  std::unordered_map<std::uint64_t, int> pair_of_;  // of two unknowns, the lesser one in front
  std::vector<Edge, Eigen::aligned_allocator<Edge>> edges_;
  std::shared_ptr<const BlockSymbolic> symbolic_;
};

/// What a report says of the poses before and after.
template <class Group>
void begin_report(const PoseSystem<Group>& system, PoseGraphReport& report);
template <class Group>
void end_report(const PoseSystem<Group>& system, PoseGraphReport& report);

extern template class PoseSystem<SE2>;
extern template class PoseSystem<SE3>;

}  // namespace trident::slam
