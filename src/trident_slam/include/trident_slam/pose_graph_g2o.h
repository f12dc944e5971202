// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "trident_slam/pose_graph.h"

namespace trident::slam {

/// What becomes of an edge whose information has a negative eigenvalue, so that its error could be
/// worth less than nothing.
enum class IndefiniteInformation {
  kNearest,  ///< the nearest positive semidefinite matrix (in the Frobenius norm) stands for it
  kRefuse,   ///< it is an Error
};

/// What was taken although it cannot be meant.
struct G2oWarnings {
  std::size_t indefinite = 0;  ///< edges whose information had a negative eigenvalue
  std::string text;            ///< one sentence about all of them, empty without any
};

/// Reads a pose graph as g2o writes it: VERTEX_SE2 and EDGE_SE2, or VERTEX_SE3:QUAT and
/// EDGE_SE3:QUAT, and FIX; plain or compressed by gzip, whatever its name. A file without a vertex
/// takes its vertices from its edges, each where the first edges that lead there from the lowest id
/// put it. Edges between ids that follow each other count as odometry (`is_trusted`).
/// Information with a negative eigenvalue is taken as the nearest positive semidefinite matrix, and
/// reported in `warnings`, unless `indefinite` says otherwise.
/// Throws Error naming file, line, field and value.
std::variant<PoseGraph2d, PoseGraph3d> read_g2o(
    const std::string& file, IndefiniteInformation indefinite = IndefiniteInformation::kNearest,
    G2oWarnings* warnings = nullptr);

/// Numbers are written such that reading them gives the same ones; compressed if the name ends in
/// .gz. Throws Error when the file cannot be written.
template <class Group>
void write_g2o(const PoseGraph<Group>& graph, const std::string& file);

}  // namespace trident::slam
