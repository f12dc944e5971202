// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "planning/curves/curve_checker.h"
#include "planning/curves/motion_curve.h"
#include "planning/curves/motion_set.h"
#include "planning/grids/bucket_queue.h"
#include "planning/grids/travel_costs.h"
#include "planning/poses/obstacle_heuristic.h"
#include "planning/poses/state_set.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// How a search over poses goes about it. Lengths in cells.
struct PoseSearchOptions {
  MotionModel model = MotionModel::kDubins;  ///< Of the curves to the goal.
  double radius = 8.0;                       ///< Of these curves.
  double curve_window = 200.0;  ///< Within this of the goal the length of the curve to it counts.
  /// Factor of the estimates: what is left to the goal beyond them, most of all a turn at the goal,
  /// is searched for near the goal only. Paths cost at most this factor more than they must.
  float estimate_weight = 1.25F;
  double expansion_ratio = 3.5;
  double max_expansion_length = 60.0;
  int max_expansion_cost = 200;
  bool overrides_max_cost = false;  ///< Near the goal any cost will do.
  int max_on_approach_iterations = 1000;
  int check_interval = 256;  ///< Iterations between looks at the cancel flag and the clock.
};

/// A* over poses that a set of motions leads to, cells by headings (Dolgov, Thrun, Montemerlo,
/// Diebel, IJRR 29, 2010): nodes keep their exact pose, so that paths consist of whole motions and
/// end with a curve to the goal's exact pose. A motion is checked for contact when the search comes
/// to its end, not before.
class PoseSearch {
 public:
  /// kNoPath also when the search ended at a pose that is near enough.
  enum class Result { kFound, kNoPath, kCanceled, kTimeout, kTooManyIterations };

  /// What a search is about. Poses in cells of the grid, from its origin.
  struct Query {
    const CurveChecker* checker = nullptr;
    ObstacleHeuristic* heuristic = nullptr;
    Pose2 start, goal;
    double offset = 0.0;         ///< The start's heading less that of `start_heading` in the set.
    unsigned start_heading = 0;  ///< In the set.
    double exit_cost = 0.0;      ///< From cells that the heuristic cannot reach, where > 0.
    Pose2 exit;                  ///< Where they are left for.
    double exit_reach = 0.0;     ///< How far they may lie from the start.
    std::int64_t max_iterations = -1;  ///< Negative: no limit.
    std::chrono::steady_clock::time_point deadline;
    double stop_within = 0.0;  ///< The first pose this near to the goal ends the search.
  };

  PoseSearch(const MotionSet& motions, const TravelCosts& costs, const PoseSearchOptions& options);

  Result search(const CostGrid& grid, const Query& query, const CancelFlag& cancel);
  /// The path of the last search that found one.
  TravelPath path() const { return trace(best_.node, true); }
  double cost() const { return best_.cost; }
  /// The path to the pose nearest to the goal that the last search came to.
  TravelPath nearest_path() const { return trace(nearest_.node, false); }
  double nearest_cost() const { return static_cast<double>(nodes_[nearest_.node].g); }
  double nearest_distance() const { return nearest_.distance; }
  std::size_t iterations() const { return iterations_; }

 private:
  struct Node {
    double x, y;
    float g;
    std::uint32_t parent;
    std::uint16_t heading;
    std::uint16_t primitive;
  };
  /// A motion that waits for its turn.
  struct Candidate {
    std::uint32_t parent;
    float g;
    std::uint16_t primitive;
    bool has_curve;  ///< The curve to the goal is part of its key.
  };
  struct Offset {
    double x, y;
  };
  /// Of the query's offset.
  struct Rotation {
    double cos = 1.0, sin = 0.0;
  };
  /// The cheapest path into the goal so far: a node, and the curve from it.
  struct Best {
    std::uint32_t node = 0;
    MotionCurve curve;
    float cost = 0.0F;
  };
  /// The node nearest to the goal so far.
  struct Nearest {
    std::uint32_t node = 0;
    double distance = 0.0;
  };
  static constexpr std::uint16_t kNoPrimitive = 0xFFFF;

  void begin(const CostGrid& grid, const Query& query);
  Result run(const CancelFlag& cancel);
  std::optional<Result> interrupted(const CancelFlag& cancel) const;
  bool is_done(std::size_t found_at) const;
  bool take(const Candidate& candidate);
  bool is_deferred(const Candidate& candidate, const Node& node);
  void add_start();
  void add_node(const Node& node);
  void expand(std::uint32_t index);
  float motion_cost(const Node& from, const Primitive& p, std::uint8_t cell_cost) const;
  void try_goal(std::uint32_t index);
  float estimate(int x, int y) const;
  float curve_estimate(const Node& node) const;
  std::uint64_t key_of(float f) const;
  Pose2 pose_of(const Node& node) const;
  TravelPath trace(std::uint32_t node, bool to_goal) const;
  void append_motion(const Node& from, const Primitive& p, TravelPath& path) const;

  const MotionSet& motions_;
  TravelCosts costs_;
  PoseSearchOptions options_;
  CostGrid grid_;
  Query query_;
  StateSet closed_;
  std::vector<Offset> ends_;  ///< Of the primitives, turned by the query's offset.
  std::vector<Node> nodes_;
  BucketQueue<Candidate> queue_;
  Rotation rotation_;
  std::uint64_t base_key_ = 0;
  std::size_t iterations_ = 0;
  int until_expansion_ = 0;
  Best best_;
  Nearest nearest_;
};

}  // namespace trident::nav
