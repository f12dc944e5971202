// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <queue>
#include <string_view>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/regular_file.h"
#include "trident_base/string_util.h"
#include "trident_slam/pose_graph_g2o.h"

namespace trident {
namespace {

using Graph = std::variant<std::monostate, PoseGraph2d, PoseGraph3d>;

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

/// The words of one line, taken one after the other.
class Line {
 public:
  Line(std::string_view text, const std::string& file, int number)
      : rest_(text), file_(file), number_(number) {
    skip_blanks();
  }

  bool is_at_end() const { return rest_.empty(); }
  std::string_view word() {
    const std::size_t end = std::min(rest_.find_first_of(" \t\r"), rest_.size());
    const std::string_view result = rest_.substr(0, end);
    rest_.remove_prefix(end);
    skip_blanks();
    return result;
  }
  double number(const char* field) {
    const std::string_view text = word();
    const std::string_view digits = text.substr(starts_with(text, "+") ? 1 : 0);
    double value = 0.0;
    const auto [end, problem] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem == std::errc::result_out_of_range) value = 0.0;  // fewer digits than a double has
    const bool is_whole = !text.empty() && end == digits.data() + digits.size();
    if (!is_whole || !std::isfinite(value)) fail(field, text, "a finite number");
    return value;
  }
  int id(const char* field) {
    const std::string_view text = word();
    int value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || problem != std::errc() || end != text.data() + text.size()) {
      fail(field, text, "a whole number that fits into 32 bits");
    }
    return value;
  }
  void end() {
    if (!is_at_end()) fail("what follows the last field", rest_, "nothing");
  }
  [[noreturn]] void fail(std::string_view field, std::string_view value,
                         const std::string& wanted) const {
    const std::string shown = value.empty() ? "missing" : "'" + std::string(value) + "'";
    throw Error(where() + ": " + std::string(field) + " is " + shown + ", but must be " + wanted);
  }
  std::string where() const { return file_ + ":" + std::to_string(number_); }

 private:
  void skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size()));
  }

  std::string_view rest_;
  const std::string& file_;
  int number_;
};

void read_pose(Line& line, SE2& T) {
  const double x = line.number("x");
  const double y = line.number("y");
  T = SE2::from_xy_yaw(x, y, line.number("theta"));
}

void read_pose(Line& line, SE3& T) {
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

template <int kSize>
void read_information(Line& line, Eigen::Matrix<double, kSize, kSize>& information) {
  for (int row = 0; row < kSize; ++row) {
    for (int column = row; column < kSize; ++column) {
      const std::string field =
          "information(" + std::to_string(row) + "," + std::to_string(column) + ")";
      const double value = line.number(field.c_str());
      information(row, column) = information(column, row) = value;
    }
  }
  if (Eigen::LLT<Eigen::Matrix<double, kSize, kSize>>(information).info() == Eigen::Success) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kSize, kSize>> solver(information);
  const double least = solver.eigenvalues().minCoeff();
  if (least < -1e-6 * solver.eigenvalues().cwiseAbs().maxCoeff()) {
    line.fail("the least eigenvalue of the information", number_text(least), ">= 0");
  }
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

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  std::variant<PoseGraph2d, PoseGraph3d> read() {
    const std::string text = read_whole(file_);
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      Line line(std::string_view(text).substr(begin, end - begin), file_, ++number);
      begin = end + 1;
      if (!line.is_at_end()) read_line(line, number);
    }
    if (!plane_.is_empty() && !space_.is_empty()) {
      throw Error(file_ + ": holds both SE2 and SE3, but must be of one kind");
    }
    if (plane_.is_empty() && space_.is_empty())
      throw Error(file_ + ": holds no vertex and no edge");
    if (!plane_.is_empty()) return graph_of(plane_);
    return graph_of(space_);
  }

 private:
  void read_line(Line& line, int number) {
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
  void read_vertex(Line& line, int number, Parts<Group>& parts) {
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
  void read_edge(Line& line, int number, Parts<Group>& parts) {
    typename Parts<Group>::WaitingEdge waiting;
    waiting.line = number;
    waiting.edge.from = line.id("from");
    waiting.edge.to = line.id("to");
    if (waiting.edge.from == waiting.edge.to) {
      line.fail("to", std::to_string(waiting.edge.to), "another vertex than from");
    }
    read_pose(line, waiting.edge.T_from_to);
    read_information(line, waiting.edge.information);
    line.end();
    waiting.edge.is_trusted = waiting.edge.to - waiting.edge.from == 1;
    parts.edges.push_back(waiting);
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
    Line({}, file_, number).fail(field, std::to_string(id), "the id of a vertex of this file");
  }

  // Breadth first from the lowest id of each connected part.
  template <class Group>
  static void add_vertices_of_edges(const Parts<Group>& parts, PoseGraph<Group>& graph) {
    std::map<int, std::vector<std::pair<int, Group>>> neighbours;
    for (const auto& [edge, number] : parts.edges) {
      neighbours[edge.from].emplace_back(edge.to, edge.T_from_to);
      neighbours[edge.to].emplace_back(edge.from, edge.T_from_to.inverse());
    }
    std::map<int, Group> poses;
    for (const auto& [root, ignored] : neighbours) {
      if (!poses.try_emplace(root, Group::identity()).second) continue;
      std::queue<int> waiting({root});
      for (; !waiting.empty(); waiting.pop()) {
        const Group T = poses.at(waiting.front());
        for (const auto& [id, T_next] : neighbours[waiting.front()]) {
          if (poses.try_emplace(id, T * T_next).second) waiting.push(id);
        }
      }
    }
    for (const auto& [id, T] : poses) graph.add_vertex(id, T);
  }

  const std::string& file_;
  Parts<SE2> plane_;
  Parts<SE3> space_;
  std::map<int, int> line_of_vertex_;
  std::vector<std::pair<int, int>> fixed_;  // id, line
};

}  // namespace

std::variant<PoseGraph2d, PoseGraph3d> read_g2o(const std::string& file) {
  return Reader(file).read();
}

}  // namespace trident
