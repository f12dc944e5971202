// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/pose_graph.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "edge_model.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

// Unlike for every structure of every graph in the process.
std::size_t next_version() {
  static std::atomic<std::size_t> version{0};
  return ++version;
}

bool is_finite(const SE2& T) { return T.p.allFinite() && std::isfinite(T.angle); }
bool is_finite(const SE3& T) { return T.p.allFinite() && T.R.coeffs().allFinite(); }

std::string edge_name(int from, int to) {
  return "pose graph: edge " + std::to_string(from) + " -> " + std::to_string(to);
}

template <class Edge>
void check_information(const Edge& edge) {
  const auto name = [&] { return edge_name(edge.from, edge.to); };
  if (!edge.information.allFinite()) throw Error(name() + ": its information must be finite");
  const double asymmetry = (edge.information - edge.information.transpose()).cwiseAbs().maxCoeff();
  if (asymmetry > 1e-9 * edge.information.cwiseAbs().maxCoeff()) {
    throw Error(name() + ": its information must be symmetric");
  }
  if (edge.information.diagonal().minCoeff() < 0.0) {
    throw Error(name() + ": the diagonal of its information must be >= 0, not " +
                number_text(edge.information.diagonal().minCoeff()));
  }
}

template <class Edge>
void check_edge(const Edge& edge) {
  const auto name = [&] { return edge_name(edge.from, edge.to); };
  if (edge.from == edge.to) throw Error(name() + ": its vertices must differ");
  if (!is_finite(edge.T_from_to)) throw Error(name() + ": its measurement must be finite");
  check_information(edge);
  if (!(edge.kernel_scale > 0.0)) {
    throw Error(name() + ": kernel_scale must be > 0, not " + number_text(edge.kernel_scale));
  }
}

}  // namespace

template <class Group>
void PoseGraph<Group>::add_vertex(int id, const Group& T_map_vertex) {
  if (has_vertex(id)) {
    throw Error("pose graph: there is a vertex " + std::to_string(id) + " already");
  }
  if (!is_finite(T_map_vertex)) {
    throw Error("pose graph: the pose of vertex " + std::to_string(id) + " must be finite");
  }
  index_of_id_[id] = vertices_.size();
  vertices_.push_back({id, T_map_vertex, false});
  structure_version_ = next_version();
}

template <class Group>
std::size_t PoseGraph<Group>::add_edge(const Edge& edge) {
  index(edge.from);
  index(edge.to);
  check_edge(edge);
  edges_.push_back(edge);
  structure_version_ = next_version();
  return edges_.size() - 1;
}

template <class Group>
void PoseGraph<Group>::remove_vertex(int id) {
  vertices_.erase(vertices_.begin() + static_cast<std::ptrdiff_t>(index(id)));
  const auto touches = [id](const Edge& edge) { return edge.from == id || edge.to == id; };
  edges_.erase(std::remove_if(edges_.begin(), edges_.end(), touches), edges_.end());
  rebuild_index();
}

template <class Group>
void PoseGraph<Group>::remove_edge(std::size_t index) {
  edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(index));
  structure_version_ = next_version();
}

template <class Group>
void PoseGraph<Group>::set_pose(int id, const Group& T_map_vertex) {
  if (!is_finite(T_map_vertex)) {
    throw Error("pose graph: the pose of vertex " + std::to_string(id) + " must be finite");
  }
  vertices_[index(id)].T_map_vertex = T_map_vertex;
}

template <class Group>
void PoseGraph<Group>::set_fixed(int id, bool is_fixed) {
  Vertex& vertex = vertices_[index(id)];
  if (vertex.is_fixed == is_fixed) return;
  vertex.is_fixed = is_fixed;
  structure_version_ = next_version();
}

template <class Group>
void PoseGraph<Group>::set_kernel(std::size_t edge, RobustKernel kernel, double scale) {
  Edge changed = edges_.at(edge);
  changed.kernel = kernel;
  changed.kernel_scale = scale;
  check_edge(changed);
  edges_[edge] = changed;
}

template <class Group>
std::size_t PoseGraph<Group>::index(int id) const {
  const auto found = index_of_id_.find(id);
  if (found == index_of_id_.end()) {
    throw Error("pose graph: there is no vertex " + std::to_string(id));
  }
  return found->second;
}

template <class Group>
void PoseGraph<Group>::rebuild_index() {
  index_of_id_.clear();
  for (std::size_t k = 0; k < vertices_.size(); ++k) index_of_id_[vertices_[k].id] = k;
  structure_version_ = next_version();
}

template <class Group>
typename Group::Tangent pose_graph_error(const Group& T_map_from, const Group& T_map_to,
                                         const Group& T_from_to) {
  using Model = EdgeModel<Group>;
  const auto T = Model::from_group(T_map_from).inverse() * Model::from_group(T_map_to);
  return Model::log(Model::from_group(T_from_to).inverse() * T);
}

template <class Group>
double pose_graph_chi2(const PoseGraph<Group>& graph) {
  double chi2 = 0.0;
  for (const auto& edge : graph.edges()) {
    const typename Group::Tangent error =
        pose_graph_error(graph.pose(edge.from), graph.pose(edge.to), edge.T_from_to);
    chi2 += error.dot(edge.information * error);
  }
  return chi2;
}

template class PoseGraph<SE2>;
template class PoseGraph<SE3>;
template SE2::Tangent pose_graph_error(const SE2&, const SE2&, const SE2&);
template SE3::Tangent pose_graph_error(const SE3&, const SE3&, const SE3&);
template double pose_graph_chi2(const PoseGraph<SE2>&);
template double pose_graph_chi2(const PoseGraph<SE3>&);

}  // namespace trident::slam
