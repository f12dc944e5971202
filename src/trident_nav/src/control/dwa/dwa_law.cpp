// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../laws.h"
#include "../steering.h"
#include "dwa_params.h"
#include "trajectory_search.h"
#include "trident_base/yaml_config.h"
#include "velocity_samples.h"

namespace trident::nav {
namespace {

/// The dynamic window approach: of the velocities that can be reached, the one whose trajectory
/// scores best; close to the goal, straight to it. Fox, Burgard, Thrun, "The dynamic window
/// approach to collision avoidance", RAM 4 (1997); scored as ROS' dwa_local_planner does.
class DwaLaw final : public ControlLaw {
 public:
  DwaLaw(const ControlSetup& setup, const DwaParams& params)
      : params_(params),
        setup_(with_limits(setup, params)),
        search_(setup_, {params.sim_time, params.sim_granularity, params.angular_sim_granularity,
                         !params.use_dwa}),
        critics_(make_critics()) {}

  double path_length_m() const override {
    return search_.reach_m(params_.forward_point_distance +
                           4.0 * setup_.footprint.circumscribed_radius);
  }

  Proposal propose(const Situation& situation) override {
    const double near_m =
        std::max(params_.forward_point_distance, 2.0 * setup_.tolerance.xy_goal_tolerance);
    if (const auto twist = straight_to_goal(situation, setup_, near_m)) {
      return {*twist, Failure::kNone, ""};
    }
    const auto chosen = search_.best(samples(situation), situation, critics_, display());
    if (!chosen) {
      return {{}, Failure::kBlocked, "Each velocity that can be reached leads to contact."};
    }
    return {*chosen, Failure::kNone, ""};
  }

  void reset() override {
    for (const auto& critic : critics_) critic->reset();
  }

 private:
  static ControlSetup with_limits(ControlSetup setup, const DwaParams& params) {
    MotionLimits& limits = setup.limits;
    limits.vx_max = std::min(limits.vx_max, params.max_vel_x.value_or(limits.vx_max));
    limits.vx_min = std::clamp(params.min_vel_x, limits.vx_min, 0.0);
    limits.vy_max = std::min(limits.vy_max, params.max_vel_y.value_or(limits.vy_max));
    limits.wz_max = std::min(limits.wz_max, params.max_vel_theta.value_or(limits.wz_max));
    limits.ax_max = std::min(limits.ax_max, params.acc_lim_x.value_or(limits.ax_max));
    limits.decel_max = std::min(limits.decel_max, params.acc_lim_x.value_or(limits.decel_max));
    limits.ay_max = std::min(limits.ay_max, params.acc_lim_y.value_or(limits.ay_max));
    limits.alpha_max = std::min(limits.alpha_max, params.acc_lim_theta.value_or(limits.alpha_max));
    return setup;
  }

  // Grids count cells, biases are per meter.
  static constexpr double kTypicalResolution = 0.05;
  // What little lacks to turn costs little; where a robot that may not reverse would be caught, it
  // outweighs what is won along the path: with 6 some of 300 got stuck at a pillar, with 8 none.
  static constexpr double kRoomShare = 8.0;

  // A robot that neither drives nor turns as fast gets nowhere; but not faster than it can be yet.
  static double slowest(double wanted, double limit, double reachable) {
    constexpr double kShare = 0.25;
    return std::min({wanted, kShare * limit, reachable});
  }

  std::vector<Twist2> samples(const Situation& situation) const {
    const double duration_s = params_.use_dwa ? setup_.period_s : params_.sim_time;
    TwistWindow window = reachable_window(setup_.limits, situation.state.twist, duration_s);
    // Nothing faster than what can still stop at the goal.
    const double stop =
        stopping_speed(distance_left(situation), setup_.limits.decel_max, setup_.period_s);
    window.hi.vx = std::max(std::min(window.hi.vx, stop), window.lo.vx);
    const VelocitySampling sampling{
        params_.vx_samples,
        setup_.limits.vy_max > 0.0 ? params_.vy_samples : 1,
        params_.vth_samples,
        slowest(params_.min_vel_trans, setup_.limits.vx_max, std::min(window.hi.vx, stop)),
        params_.max_vel_trans.value_or(0.0),
        slowest(params_.min_vel_theta, setup_.limits.wz_max,
                std::max(window.hi.wz, -window.lo.wz))};
    return sample_velocities(window, sampling);
  }

  SearchDisplay display() const {
    return {params_.publish_traj_pc, params_.publish_cost_grid_pc,
            kTypicalResolution * params_.path_distance_bias,
            kTypicalResolution * params_.goal_distance_bias, params_.occdist_scale};
  }

  TrajectoryCritics make_critics() const {
    const Aggregation all = params_.sum_scores ? Aggregation::kSum : Aggregation::kLast;
    const double path = kTypicalResolution * params_.path_distance_bias;
    const double goal = kTypicalResolution * params_.goal_distance_bias;
    const double ahead_m = params_.forward_point_distance;
    const double silent_m =
        std::min(ahead_m * params_.cheat_factor, setup_.tolerance.xy_goal_tolerance);
    TrajectoryCritics critics;
    critics.push_back(make_oscillation_critic(
        1.0, {params_.oscillation_reset_dist, params_.oscillation_reset_angle, -1.0}));
    critics.push_back(make_moving_obstacle_critic(params_.moving_obstacle_scale, search_.dt_s()));
    critics.push_back(make_obstacle_critic(params_.occdist_scale, all));
    critics.push_back(make_grid_critic(GridKind::kGoal, goal, ahead_m, silent_m, all));
    critics.push_back(make_grid_critic(GridKind::kPath, path, ahead_m, silent_m, all));
    critics.push_back(make_grid_critic(GridKind::kPath, path, 0.0, 0.0, all));
    critics.push_back(make_grid_critic(GridKind::kGoal, goal, 0.0, 0.0, all));
    critics.push_back(make_turning_room_critic(kRoomShare * (path + goal) / kTypicalResolution));
    critics.push_back(make_twirling_critic(params_.twirling_scale));
    return critics;
  }

  DwaParams params_;
  ControlSetup setup_;
  TrajectorySearch search_;
  TrajectoryCritics critics_;
};

}  // namespace

void add_dwa(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& params,
                                 const std::string& label) {
    return std::make_unique<DwaLaw>(setup, load_config_node<DwaParams>(params, label));
  };
  factory.fields = config_fields<DwaParams>();
  registry.add("dwa", factory);
  registry.add("dwa_local_planner/DWAPlannerROS", factory);
}

}  // namespace trident::nav
