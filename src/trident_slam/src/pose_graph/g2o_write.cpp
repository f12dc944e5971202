// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_slam/pose_graph_g2o.h"

namespace trident::slam {
namespace {

void append(std::string& text, double value) { (text += ' ') += number_text(value); }
void append(std::string& text, const SE2& T) {
  for (const double value : {T.p.x(), T.p.y(), T.angle}) append(text, value);
}
void append(std::string& text, const SE3& T) {
  for (const double value : {T.p.x(), T.p.y(), T.p.z(), T.R.x(), T.R.y(), T.R.z(), T.R.w()}) {
    append(text, value);
  }
}

template <class Edge>
void append_edge(std::string& text, const Edge& edge, const char* tag, int dimension) {
  text += tag + std::to_string(edge.from) + ' ' + std::to_string(edge.to);
  append(text, edge.T_from_to);
  for (int row = 0; row < dimension; ++row) {
    for (int column = row; column < dimension; ++column)
      append(text, edge.information(row, column));
  }
  text += '\n';
}

void write_whole(const std::string& text, const std::string& file) {
  const char* mode = ends_with(file, ".gz") ? "wb" : "wbT";  // T: not compressed
  gzFile out = gzopen(file.c_str(), mode);
  const bool is_written =
      out != nullptr && (text.empty() || gzwrite(out, text.data(), text.size()) > 0);
  const bool is_closed = out != nullptr && gzclose(out) == Z_OK;
  if (!is_written || !is_closed) throw Error(file + ": cannot be written");
}

}  // namespace

template <class Group>
void write_g2o(const PoseGraph<Group>& graph, const std::string& file) {
  const bool is_plane = PoseGraph<Group>::kDimension == 3;
  std::string text;
  for (const auto& vertex : graph.vertices()) {
    text += (is_plane ? "VERTEX_SE2 " : "VERTEX_SE3:QUAT ") + std::to_string(vertex.id);
    append(text, vertex.T_map_vertex);
    text += '\n';
  }
  for (const auto& vertex : graph.vertices()) {
    if (vertex.is_fixed) text += "FIX " + std::to_string(vertex.id) + '\n';
  }
  for (const auto& edge : graph.edges()) {
    append_edge(text, edge, is_plane ? "EDGE_SE2 " : "EDGE_SE3:QUAT ",
                PoseGraph<Group>::kDimension);
  }
  write_whole(text, file);
}

template void write_g2o(const PoseGraph<SE2>&, const std::string&);
template void write_g2o(const PoseGraph<SE3>&, const std::string&);

}  // namespace trident::slam
