// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "graph_slam/session/binary_stream.h"
#include "trident_base/se2.h"
#include "trident_slam/graph_slam_back_end.h"
#include "trident_slam/point_scan.h"
#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// A scan that the map is made of. The scan itself never changes and is shared.
struct Keyframe {
  SE2 T_map_base;
  std::shared_ptr<const PointScan> scan;
  double travelled = 0.0;  ///< path from the first keyframe [m]
};

enum class EdgeKind : std::uint8_t {
  kOdometry,  ///< between successive keyframes
  kRevisit,   ///< a scan that was matched against surfaces of an older part of the map
  kLoop,      ///< a loop that several candidates agreed on, or one that the user asked for
};

/// A measured transform between two keyframes.
struct GraphEdge {
  int from = 0;
  int to = 0;
  SE2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< of (x, y, yaw) in frame `to`
  EdgeKind kind = EdgeKind::kOdometry;
};

/// Keyframes, the edges between them, and submaps of successive keyframes that loops are searched
/// for for.
class KeyframeGraph {
 public:
  /// `solver` optimises; empty: ours.
  explicit KeyframeGraph(int submap_size, PoseGraphSolverMaker solver = {})
      : submap_size_(submap_size), solver_(std::move(solver)) {}

  int add(const Keyframe& keyframe);
  void add_edge(const GraphEdge& edge) { edges_.push_back(edge); }

  int size() const { return static_cast<int>(keyframes_.size()); }
  const Keyframe& operator[](int i) const { return keyframes_[static_cast<std::size_t>(i)]; }
  const SE2& pose(int i) const { return (*this)[i].T_map_base; }
  const std::vector<GraphEdge>& edges() const { return edges_; }
  std::vector<GraphEdge>& edges() { return edges_; }
  void set_pose(int i, const SE2& T) { keyframes_[static_cast<std::size_t>(i)].T_map_base = T; }

  const PoseGraphSolverMaker& solver() const { return solver_; }
  int submap_size() const { return submap_size_; }
  int submap_of(int keyframe) const { return keyframe / submap_size_; }
  int submaps() const { return (size() + submap_size_ - 1) / submap_size_; }
  int first_of(int submap) const { return submap * submap_size_; }
  int end_of(int submap) const { return std::min(size(), (submap + 1) * submap_size_); }
  /// The keyframe in the middle of a submap.
  int anchor_of(int submap) const { return (first_of(submap) + end_of(submap) - 1) / 2; }

  /// The shortest path through the edges from one submap to every other one [m]: a measure of how
  /// far both may have drifted apart. An edge that closes a loop counts as one metre.
  std::vector<double> distances_from(int submap) const;

  /// A keyframe whose scan is no longer part of the map keeps its place in the graph, with an empty
  /// scan.
  void set_scan(int i, std::shared_ptr<const PointScan> scan);

  /// What became of the keyframes when some were taken out.
  struct Removal {
    std::vector<int> kept;             ///< the old numbers of those that are left, in order
    std::vector<int> stand_in;         ///< new number of each old one, or of the one next to it
    std::vector<SE2> T_stand_in_base;  ///< where each old one was relative to its stand-in
  };
  /// Takes out keyframes; the edges to them go to the next keyframe along the path. One at least
  /// must be left.
  Removal remove(const std::vector<char>& is_removed);

  void save(BinaryWriter* writer) const;
  void load(BinaryReader* reader);

  /// Moves the keyframes to where the edges agree best; the first one stays. Cauchy's kernel holds
  /// for kRevisit edges; loops have been verified before they are edges.
  void optimize(const GraphOptimizationOptions& options);

 private:
  int submap_size_;
  PoseGraphSolverMaker solver_;
  std::vector<Keyframe> keyframes_;
  std::vector<GraphEdge> edges_;
};

/// Information of (x, y, yaw) from standard deviations of x and y [m] and of yaw [rad].
Eigen::Matrix3d sigma_information(double sigma, double sigma_yaw);

/// Error of an edge: log(T_from_to^-1 * T_map_from^-1 * T_map_to).
Eigen::Vector3d edge_error(const GraphEdge& edge, const SE2& T_map_from, const SE2& T_map_to);

}  // namespace trident::slam
