// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <utility>
#include <vector>

#include "keyframe_graph.h"
#include "trident_slam/graph_slam_back_end.h"
#include "trident_slam/graph_slam_options.h"

namespace trident::slam {

/// What the newest keyframe has made of older ones.
struct PruneResult {
  std::vector<int> replaced;  ///< newer scans have replaced them
  /// Scans without the points that the newest one saw through.
  std::vector<std::pair<int, std::shared_ptr<const PointScan>>> thinned;
};

/// Finds scans that newer ones have replaced. Every scan begins with a score of 1, from which each
/// newer scan takes the part that both share, as slam_toolbox' lifelong mode does
/// (S. Macenski, I. Jambrecic, "SLAM Toolbox", JOSS 6(61), 2021). Beyond that, a scan stays while
/// newer ones have not seen nearly all of its points again, and points that a newer scan has seen
/// through go at once.
class ScanPruner {
 public:
  explicit ScanPruner(const LifelongOptions& options, const PruningOptions& pruning = {},
                      const FreeSpaceOptions& free_space = {})
      : options_(options), pruning_(pruning), free_space_(free_space) {}

  PruneResult update(const KeyframeGraph& graph);
  /// The graph has no more than these of its keyframes, in this order.
  void keep(const std::vector<int>& kept);
  void clear() { memories_.clear(); }

 private:
  struct Memory {
    double score = 1.0;
    std::shared_ptr<const PointScan> scan;
    std::vector<char> seen_again;  ///< per point of the scan
  };
  /// What the newest scan has seen of an older one's points.
  struct Comparison {
    std::shared_ptr<PointScan> thinned;  ///< without the points that were seen through
    std::vector<char> seen_again;        ///< per point of `thinned`
    int seen = 0;                        ///< points of the older scan that were seen
  };
  class View;
  struct Overlap;

  static Overlap overlap_of(const Eigen::AlignedBox2d& newest, const Eigen::AlignedBox2d& older);
  static Comparison compare(const View& newest, const Memory& memory, const SE2& T_map_base);
  void update_score(const Overlap& overlap, double readings, int edges, Memory* memory) const;

  static std::vector<char> near_newest(const KeyframeGraph& graph, double radius);
  std::vector<int> candidates(const KeyframeGraph& graph, double radius) const;
  bool is_replaced(const Memory& memory) const;
  Memory& memory_of(const KeyframeGraph& graph, int keyframe);

  LifelongOptions options_;
  PruningOptions pruning_;
  FreeSpaceOptions free_space_;
  std::vector<Memory> memories_;
};

}  // namespace trident::slam
