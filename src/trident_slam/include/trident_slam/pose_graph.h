// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "trident_base/se2.h"
#include "trident_base/se3.h"

namespace trident::slam {

/// How the square s = e' Omega e of an edge counts in the cost. c is the edge's `kernel_scale`, in
/// standard deviations.
enum class RobustKernel {
  kNone,          ///< s
  kHuber,         ///< s up to c^2, then linear in sqrt(s)
  kCauchy,        ///< c^2 log(1 + s / c^2)
  kDcs,           ///< dynamic covariance scaling with phi = c^2 (Agarwal et al. 2013)
  kGemanMcClure,  ///< c^2 s / (c^2 + s)
};

/// "none", "huber", "cauchy", "dcs", "geman_mcclure"; anything else is an Error.
RobustKernel robust_kernel_from_name(std::string_view name);
/// The inverse of robust_kernel_from_name().
std::string robust_kernel_name(RobustKernel kernel);

/// rho(s) of a kernel with scale c, and its derivative, the weight of the edge.
struct RobustValue {
  double cost = 0.0;    ///< rho(s)
  double weight = 1.0;  ///< d rho / d s, in [0, 1]
};
/// `squared_error`: s = e' Omega e >= 0; `scale`: c > 0, not read for kNone.
RobustValue evaluate_robust_kernel(RobustKernel kernel, double scale, double squared_error);

/// Poses and measurements between pairs of them. Group is SE2 or SE3. The order of vertices and
/// edges is that of their insertion; indices stay valid until something is removed.
template <class Group>
class PoseGraph {
 public:
  /// 3 in the plane, 6 in space.
  static constexpr int kDimension = Group::Tangent::RowsAtCompileTime;
  using Information = Eigen::Matrix<double, kDimension, kDimension>;

  /// One pose of the graph.
  struct Vertex {
    int id = 0;             ///< the caller's; unique in the graph
    Group T_map_vertex;     ///< its start before, its optimum after an optimization
    bool is_fixed = false;  ///< see set_fixed()
  };

  /// The error is log(T_from_to^-1 * T_map_from^-1 * T_map_to), in the order of Group::Tangent.
  struct Edge {
    int from = 0;                                       ///< id of a vertex
    int to = 0;                                         ///< id of another vertex
    Group T_from_to;                                    ///< as measured
    Information information = Information::Identity();  ///< Omega, of the error above
    RobustKernel kernel = RobustKernel::kNone;          ///< kNone: a plain square
    double kernel_scale = 1.0;                          ///< [standard deviations]
    bool is_trusted = false;  ///< odometry: graduated non-convexity never doubts it
  };

  /// Throws Error when the id is taken or the pose is not finite.
  void add_vertex(int id, const Group& T_map_vertex);
  /// Throws Error when a vertex is unknown, both are the same, a number is not finite, the
  /// information is not symmetric with a diagonal >= 0, or the scale is not > 0. Returns the index.
  std::size_t add_edge(const Edge& edge);
  /// Removes the vertex and its edges.
  void remove_vertex(int id);
  /// Later edges move up: their indices are one less afterwards.
  void remove_edge(std::size_t index);

  /// Whether the id is taken.
  bool has_vertex(int id) const { return index_of_id_.count(id) != 0; }
  /// Throws Error if there is no such vertex.
  const Group& pose(int id) const { return vertices_[index(id)].T_map_vertex; }
  /// Throws Error for an unknown vertex or a pose that is not finite; fixed ones can be set, too.
  void set_pose(int id, const Group& T_map_vertex);
  /// A fixed vertex is not moved. In a connected part without any, the one that came first is held.
  void set_fixed(int id, bool is_fixed);
  /// Kernels may change between optimisations; the structure stays.
  void set_kernel(std::size_t edge, RobustKernel kernel, double scale);
  /// See Edge::is_trusted. `edge` is not checked.
  void set_trusted(std::size_t edge, bool is_trusted) { edges_[edge].is_trusted = is_trusted; }

  const std::vector<Vertex>& vertices() const { return vertices_; }  ///< in the order of insertion
  const std::vector<Edge>& edges() const { return edges_; }          ///< in the order of insertion
  /// Position of a vertex in `vertices()`. Throws Error if there is no such vertex.
  std::size_t index(int id) const;
  /// For optimizers: by position in vertices(), without checks.
  void set_pose_at(std::size_t index, const Group& T) { vertices_[index].T_map_vertex = T; }

  /// Grows whenever vertices, edges or fixed vertices change: a cached factorisation goes by it.
  std::size_t structure_version() const { return structure_version_; }

 private:
  void rebuild_index();

  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  std::unordered_map<int, std::size_t> index_of_id_;
  std::size_t structure_version_ = 0;
};

/// Error of one edge (see PoseGraph::Edge) for these two poses.
template <class Group>
typename Group::Tangent pose_graph_error(const Group& T_map_from, const Group& T_map_to,
                                         const Group& T_from_to);

/// Sum of e' Omega e over all edges, without kernels.
template <class Group>
double pose_graph_chi2(const PoseGraph<Group>& graph);

using PoseGraph2d = PoseGraph<SE2>;
using PoseGraph3d = PoseGraph<SE3>;

extern template class PoseGraph<SE2>;
extern template class PoseGraph<SE3>;

}  // namespace trident::slam
