// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "../config_split.h"
#include "../dwa/trajectory_search.h"
#include "../dwa/velocity_samples.h"
#include "../laws.h"
#include "../limit_params.h"
#include "../steering.h"
#include "dwb_critics.h"
#include "dwb_params.h"
#include "trident_base/yaml_config.h"

namespace trident::nav {
namespace {

SearchParams search_params(const DwbParams& params, const MotionLimits& limits) {
  SearchParams search{params.sim_time, params.linear_granularity, params.angular_granularity,
                      params.trajectory_generator_name == DwbGenerator::kStandard};
  if (params.discretize_by_time) {
    search.granularity_m = limits.vx_max * params.time_granularity;
    search.angular_granularity = limits.wz_max * params.time_granularity;
  }
  return search;
}

/// Nav2's DWB: velocities whose trajectories are scored by the critics that the user lists.
class DwbLaw final : public ControlLaw {
 public:
  /// `critics`: maps of their keys under their names.
  DwbLaw(const ControlSetup& setup, const DwbParams& params, const ConfigNode& critics,
         const std::string& label)
      : params_(params),
        setup_(with_limits(setup, params)),
        search_(setup_, search_params(params, setup_.limits)) {
    critics_.push_back(make_moving_obstacle_critic(params.moving_obstacle_scale, search_.dt_s()));
    const auto registry = dwb_critics();
    const DwbCriticSetup critic_setup{setup_.tolerance, search_.dt_s(), params.sim_time,
                                      setup_.footprint.circumscribed_radius};
    for (const std::string& name : params.critics) {
      const ConfigNode* given = critics.find(name);
      const ConfigNode node = given != nullptr ? *given : parse_yaml("{}", label);
      const ConfigNode* type = node.find("class");
      const DwbCriticFactory& make =
          registry.get(dwb_critic_type(type != nullptr ? type->scalar : name));
      critics_.push_back(make(critic_setup, node, label, name));
    }
  }

  double path_length_m() const override {
    return std::max(params_.forward_prune_distance,
                    search_.reach_m(4.0 * setup_.footprint.circumscribed_radius));
  }
  Proposal propose(const Situation& situation) override;
  void reset() override {
    for (const auto& critic : critics_) critic->reset();
  }

 private:
  static ControlSetup with_limits(ControlSetup setup, const DwbParams& params);
  void sample(const Situation& situation);

  DwbParams params_;
  ControlSetup setup_;
  TrajectorySearch search_;
  TrajectoryCritics critics_;
  std::vector<Twist2> samples_;
};

ControlSetup DwbLaw::with_limits(ControlSetup setup, const DwbParams& params) {
  MotionLimits& limits = setup.limits;
  limits.vx_min = std::max(limits.vx_min, params.min_vel_x);
  cap_limit(params.max_vel_x, &limits.vx_max);
  cap_limit(params.max_vel_y, &limits.vy_max);
  cap_limit(params.min_vel_y, &limits.vy_max);
  cap_limit(params.max_vel_theta, &limits.wz_max);
  cap_limit(params.acc_lim_x, &limits.ax_max);
  cap_limit(params.decel_lim_x, &limits.decel_max);
  cap_limit(params.acc_lim_y, &limits.ay_max);
  cap_limit(params.decel_lim_y, &limits.ay_max);
  cap_limit(params.acc_lim_theta, &limits.alpha_max);
  cap_limit(params.decel_lim_theta, &limits.alpha_max);
  return setup;
}

void DwbLaw::sample(const Situation& situation) {
  const bool is_standard = params_.trajectory_generator_name == DwbGenerator::kStandard;
  const double duration_s = is_standard ? params_.sim_time : setup_.period_s;
  TwistWindow window = reachable_window(setup_.limits, situation.state.twist, duration_s);
  // Nothing faster than what can still stop at the goal.
  const double stop =
      stopping_speed(distance_left(situation), setup_.limits.decel_max, setup_.period_s);
  window.hi.vx = std::max(std::min(window.hi.vx, stop), window.lo.vx);
  // To stand is often a local minimum of the scores, and gets the robot nowhere.
  constexpr double kShare = 0.1;
  const double slowest = std::max(params_.min_speed_xy, kShare * setup_.limits.vx_max);
  const double slowest_turn = std::max(params_.min_speed_theta, kShare * setup_.limits.wz_max);
  samples_.clear();
  append_velocities(
      window,
      {params_.vx_samples, setup_.limits.vy_max > 0.0 ? params_.vy_samples : 1,
       params_.vtheta_samples, std::min(slowest, window.hi.vx), params_.max_speed_xy.value_or(0.0),
       std::min(slowest_turn, std::max(window.hi.wz, -window.lo.wz))},
      &samples_);
}

Proposal DwbLaw::propose(const Situation& situation) {
  const double near_m = 2.0 * setup_.tolerance.xy_goal_tolerance;
  if (const auto twist = straight_to_goal(situation, setup_, near_m)) {
    return {*twist, Failure::kNone, ""};
  }
  sample(situation);
  const auto chosen = search_.best(samples_, situation, critics_, {});
  if (!chosen) {
    return {{}, Failure::kBlocked, "Each velocity that can be reached leads to contact."};
  }
  return {*chosen, Failure::kNone, ""};
}

}  // namespace

void add_dwb(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& given,
                                 const std::string& label) {
    ConfigNode critics = given;
    const ConfigNode own = take_keys(&critics, {"critics"});
    const auto names = load_config_node<DwbParams>(own, label).critics;
    ConfigNode rest = given;
    critics = take_keys(&rest, names);
    return std::make_unique<DwbLaw>(setup, load_config_node<DwbParams>(rest, label), critics,
                                    label);
  };
  factory.fields = config_fields<DwbParams>();
  registry.add("dwb", factory);
  registry.add("dwb_core::DWBLocalPlanner", factory);
}

}  // namespace trident::nav
