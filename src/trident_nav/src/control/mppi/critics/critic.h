// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "../mppi_model.h"
#include "../mppi_params.h"
#include "../rollout.h"
#include "trident_base/registry.h"
#include "trident_nav/control/control_law.h"

namespace trident::nav {

/// What critics compare trajectories with; positions are relative to where the robot is.
struct CriticScene {
  const MppiModel& model;
  Pose2 origin;  ///< Where the robot is, in the costmap's frame.
  CostGrid grid;
  const Tracks& tracks;
  std::vector<float> path_x, path_y;
  std::vector<float> path_cosine, path_sine;  ///< Direction of travel.
  std::vector<float> path_yaw;                ///< Wanted headings: the path's own, or the travel's.
  float path_spacing = 0.0F;
  bool is_reverse = false;
  bool leaves_backwards = false;  ///< Only trajectories backwards get on along the path.
  bool has_headings = false;
  bool reaches_goal = false;
  double blocked_ratio = 0.0;  ///< Of the path's points up to the furthest.
  int furthest = 0;            ///< Point of the path nearest to the farthest trajectory's end.
  float goal_x = 0.0F, goal_y = 0.0F, goal_yaw = 0.0F;
  double goal_distance_m = 0.0;

  int last_point() const { return static_cast<int>(path_x.size()) - 1; }
};

/// Scores trajectories, kLanes at a time. Const calls come from several threads.
class MppiCritic {
 public:
  explicit MppiCritic(const CriticParams& params)
      : power_(params.cost_power), weight_(static_cast<float>(params.cost_weight)) {}
  MppiCritic(const MppiCritic&) = delete;
  MppiCritic& operator=(const MppiCritic&) = delete;
  virtual ~MppiCritic() = default;

  /// False where this critic has nothing to say.
  virtual bool is_active(const CriticScene& /*scene*/) const { return true; }
  /// Adds (weight * cost) to the power to the cost of each lane.
  void add(const CriticScene& scene, const Rollouts& rollouts, float* total) const;

 private:
  /// The cost of each lane, >= 0.
  virtual void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const = 0;

  int power_;
  float weight_;
};

using MppiCriticFactory =
    std::function<std::unique_ptr<MppiCritic>(const MppiParams& params, const MppiModel& model)>;
using MppiCriticRegistry = Registry<MppiCriticFactory>;

// One line per source that registers critics, here and in critic.cpp.
void add_goal_critics(MppiCriticRegistry& registry);
void add_motion_critics(MppiCriticRegistry& registry);
void add_obstacle_critics(MppiCriticRegistry& registry);
void add_path_critics(MppiCriticRegistry& registry);
void add_track_critic(MppiCriticRegistry& registry);

/// The critics that the parameters name and enable. Throws Error for an unknown name.
std::vector<std::unique_ptr<MppiCritic>> make_mppi_critics(const MppiParams& params,
                                                           const MppiModel& model);

}  // namespace trident::nav
