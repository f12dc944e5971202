// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <queue>
#include <string_view>
#include <vector>

#include "g2o_line.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/regular_file.h"
#include "trident_base/string_util.h"
#include "trident_slam/pose_graph_g2o.h"

namespace trident::slam {
namespace {

using Graph = std::variant<std::monostate, PoseGraph2d, PoseGraph3d>;

/// zlib reads plain files, too; what a file is follows from its first bytes.
std::string read_whole(const std::string& file) {
  check_no_device(file, "a g2o file");
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
  if (in == nullptr) throw Error(file + ": cannot be read");
  std::string text;
  std::array<char, 1 << 16> part{};
  int count = 0;
  while ((count = gzread(in.get(), part.data(), part.size())) > 0) {
    text.append(part.data(), static_cast<std::size_t>(count));
  }
  int status = Z_OK;
  const std::string message = gzerror(in.get(), &status);
  if (count < 0 || (status != Z_OK && status != Z_STREAM_END)) {
    throw Error(file + ": cannot be read to its end: " + message);
  }
  return text;
}

void read_pose(G2oLine& line, SE2& T) {
  const double x = line.number("x");
  const double y = line.number("y");
  T = SE2::from_xy_yaw(x, y, line.number("theta"));
}

void read_pose(G2oLine& line, SE3& T) {
  for (int k = 0; k < 3; ++k) T.p[k] = line.number(std::array{"x", "y", "z"}[k]);
  for (int k = 0; k < 4; ++k) {
    T.R.coeffs()[k] = line.number(std::array{"qx", "qy", "qz", "qw"}[k]);
  }
  const double norm = T.R.norm();
  // Printed with few digits, its length is not quite 1; any other is a mistake.
  if (!(std::abs(norm - 1.0) < 0.01)) {
    line.fail("the length of the quaternion", number_text(norm), "1");
  }
  T.R.coeffs() /= norm;
}

/// Reads the upper triangle. Returns the least eigenvalue if it is negative beyond rounding, else
/// 0; then `information` is the nearest positive semidefinite matrix.
template <int kSize>
double read_information(G2oLine& line, Eigen::Matrix<double, kSize, kSize>& information) {
  for (int row = 0; row < kSize; ++row) {
    for (int column = row; column < kSize; ++column) {
      const std::string field =
          "information(" + std::to_string(row) + "," + std::to_string(column) + ")";
      const double value = line.number(field.c_str());
      information(row, column) = information(column, row) = value;
    }
  }
  if (Eigen::LLT<Eigen::Matrix<double, kSize, kSize>>(information).info() == Eigen::Success) {
    return 0.0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kSize, kSize>> solver(information);
  const double least = solver.eigenvalues().minCoeff();
  if (least >= -1e-6 * solver.eigenvalues().cwiseAbs().maxCoeff()) return 0.0;
  // Higham, Computing a nearest symmetric positive semidefinite matrix, 1988: as a product with its
  // own transpose its diagonal stays >= 0.
  const Eigen::Matrix<double, kSize, kSize> root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  information = root * root.transpose();
  return least;
}

/// Edges wait until every vertex is known, as they may come first.
template <class Group>
struct Parts {
  struct WaitingEdge {
    typename PoseGraph<Group>::Edge edge;
    int line = 0;
  };
  std::vector<std::pair<int, Group>> vertices;
  std::vector<WaitingEdge, Eigen::aligned_allocator<WaitingEdge>> edges;
  bool is_empty() const { return vertices.empty() && edges.empty(); }
};

/// Line by line in one pass; what needs all vertices (edges, FIX) is resolved at the end.
class Reader {
 public:
  Reader(const std::string& file, IndefiniteInformation indefinite)
      : file_(file), indefinite_(indefinite) {}

  std::variant<PoseGraph2d, PoseGraph3d> read() {
    const std::string text = read_whole(file_);
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      G2oLine line(std::string_view(text).substr(begin, end - begin), file_, ++number);
      begin = end + 1;
      if (!line.is_at_end()) read_line(line, number);
    }
    require_one_kind();
    if (!plane_.is_empty()) return graph_of(plane_);
    return graph_of(space_);
  }

  G2oWarnings warnings() const {
    if (indefinite_edges_ == 0) return {};
    return {indefinite_edges_,
            file_ + ": the information of " + std::to_string(indefinite_edges_) + " of " +
                std::to_string(plane_.edges.size() + space_.edges.size()) +
                " edges is not positive semidefinite; the nearest matrix that is stands for it (" +
                first_indefinite_ + ")"};
  }

 private:
  void require_one_kind() const {
    if (!plane_.is_empty() && !space_.is_empty()) {
      throw Error(file_ + ": holds both SE2 and SE3, but must be of one kind");
    }
    if (plane_.is_empty() && space_.is_empty())
      throw Error(file_ + ": holds no vertex and no edge");
  }

  void read_line(G2oLine& line, int number) {
    const std::string_view tag = line.word();
    if (starts_with(tag, "#")) return;
    if (tag == "VERTEX_SE2") {
      read_vertex(line, number, plane_);
    } else if (tag == "VERTEX_SE3:QUAT") {
      read_vertex(line, number, space_);
    } else if (tag == "EDGE_SE2") {
      read_edge(line, number, plane_);
    } else if (tag == "EDGE_SE3:QUAT") {
      read_edge(line, number, space_);
    } else if (tag == "FIX") {
      do {
        fixed_.emplace_back(line.id("id"), number);
      } while (!line.is_at_end());
    } else {
      line.fail("the tag", tag,
                "VERTEX_SE2, EDGE_SE2, VERTEX_SE3:QUAT, EDGE_SE3:QUAT, FIX or a comment (#)");
    }
  }

  template <class Group>
  void read_vertex(G2oLine& line, int number, Parts<Group>& parts) {
    const int id = line.id("id");
    Group T;
    read_pose(line, T);
    line.end();
    const auto [known, is_new] = line_of_vertex_.try_emplace(id, number);
    if (!is_new) {
      line.fail("id", std::to_string(id), "new: line " + std::to_string(known->second) + " has it");
    }
    parts.vertices.emplace_back(id, T);
  }

  template <class Group>
  void read_edge(G2oLine& line, int number, Parts<Group>& parts) {
    typename Parts<Group>::WaitingEdge waiting;
    waiting.line = number;
    waiting.edge.from = line.id("from");
    waiting.edge.to = line.id("to");
    if (waiting.edge.from == waiting.edge.to) {
      line.fail("to", std::to_string(waiting.edge.to), "another vertex than from");
    }
    read_pose(line, waiting.edge.T_from_to);
    const double least = read_information(line, waiting.edge.information);
    if (least < 0.0) take_indefinite(line, least);
    line.end();
    // Edges between successive ids are taken for odometry.
    waiting.edge.is_trusted = waiting.edge.to - waiting.edge.from == 1;
    parts.edges.push_back(waiting);
  }

  void take_indefinite(const G2oLine& line, double least) {
    if (indefinite_ == IndefiniteInformation::kRefuse) {
      line.fail("the least eigenvalue of the information", number_text(least), ">= 0");
    }
    if (indefinite_edges_++ == 0) {
      first_indefinite_ =
          line.where() + " is the first, with a least eigenvalue of " + number_text(least);
    }
  }

  template <class Group>
  PoseGraph<Group> graph_of(const Parts<Group>& parts) {
    PoseGraph<Group> graph;
    for (const auto& [id, T] : parts.vertices) graph.add_vertex(id, T);
    if (parts.vertices.empty()) add_vertices_of_edges(parts, graph);
    for (const auto& [edge, number] : parts.edges) {
      check_vertex(graph, edge.from, "from", number);
      check_vertex(graph, edge.to, "to", number);
      graph.add_edge(edge);
    }
    for (const auto& [id, number] : fixed_) {
      check_vertex(graph, id, "id", number);
      graph.set_fixed(id, true);
    }
    return graph;
  }

  template <class Group>
  void check_vertex(const PoseGraph<Group>& graph, int id, const char* field, int number) const {
    if (graph.has_vertex(id)) return;
    G2oLine({}, file_, number).fail(field, std::to_string(id), "the id of a vertex of this file");
  }

  template <class Group>
  using Neighbors = std::map<int, std::vector<std::pair<int, Group>>>;

  // Breadth first to all that is connected to the root, whose pose is known.
  template <class Group>
  static void spread_from(int root, const Neighbors<Group>& neighbors,
                          std::map<int, Group>& poses) {
    std::queue<int> waiting({root});
    for (; !waiting.empty(); waiting.pop()) {
      const Group T = poses.at(waiting.front());
      for (const auto& [id, T_next] : neighbors.at(waiting.front())) {
        if (poses.try_emplace(id, T * T_next).second) waiting.push(id);
      }
    }
  }

  // From the lowest id of each connected part.
  template <class Group>
  static void add_vertices_of_edges(const Parts<Group>& parts, PoseGraph<Group>& graph) {
    Neighbors<Group> neighbors;
    for (const auto& [edge, number] : parts.edges) {
      neighbors[edge.from].emplace_back(edge.to, edge.T_from_to);
      neighbors[edge.to].emplace_back(edge.from, edge.T_from_to.inverse());
    }
    std::map<int, Group> poses;
    for (const auto& [root, ignored] : neighbors) {
      if (poses.try_emplace(root, Group::identity()).second) spread_from(root, neighbors, poses);
    }
    for (const auto& [id, T] : poses) graph.add_vertex(id, T);
  }

  const std::string& file_;
  IndefiniteInformation indefinite_;
  std::size_t indefinite_edges_ = 0;
  std::string first_indefinite_;
  Parts<SE2> plane_;
  Parts<SE3> space_;
  std::map<int, int> line_of_vertex_;
  std::vector<std::pair<int, int>> fixed_;  // id, line
};

}  // namespace

std::variant<PoseGraph2d, PoseGraph3d> read_g2o(const std::string& file,
                                                IndefiniteInformation indefinite,
                                                G2oWarnings* warnings) {
  Reader reader(file, indefinite);
  auto graph = reader.read();
  if (warnings != nullptr) *warnings = reader.warnings();
  return graph;
}

}  // namespace trident::slam
