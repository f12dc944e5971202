// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../dwa/trajectory_search.h"
#include "../dwa/velocity_samples.h"
#include "../laws.h"
#include "../limit_params.h"
#include "../steering.h"
#include "dead_end_escape.h"
#include "trajectory_planner_params.h"
#include "trident_base/angle.h"
#include "trident_base/yaml_config.h"

namespace trident::nav {
namespace {

/// Of the speed of an escape.
constexpr double kSlowest = 0.25;
/// Farther away, a dead end is behind the robot [circumscribed radii].
constexpr double kLeavingRadii = 8.0;

/// Trajectory rollout: forward velocities first, turns on the spot where those are no worse, and
/// where neither is free of contact, sideways and then slowly backwards, until the robot has left
/// the place. Gerkey and Konolige, "Planning and control in unstructured terrain", ICRA workshop on
/// path planning on costmaps (2008); scored as ROS' base_local_planner does.
class TrajectoryPlannerLaw final : public ControlLaw {
 public:
  TrajectoryPlannerLaw(const ControlSetup& setup, const TrajectoryPlannerParams& params)
      : params_(params),
        setup_(with_limits(setup)),
        search_(setup_, {params.sim_time, params.sim_granularity,
                         params.angular_sim_granularity.value_or(params.sim_granularity), true}),
        escape_({params.escape_reset_dist, params.escape_reset_theta,
                 kLeavingRadii * setup.footprint.circumscribed_radius}) {
    add_critics();
  }

  MotionLimits limits(const MotionLimits& robot) const override;
  double path_length_m() const override {
    return search_.reach_m(params_.heading_lookahead + 4.0 * setup_.footprint.circumscribed_radius);
  }
  Proposal propose(const Situation& situation) override;
  void reset() override {
    for (const auto& critic : critics_) critic->reset();
    escape_.reset();
    last_drive_.reset();
  }

 private:
  ControlSetup with_limits(ControlSetup setup) const;
  void add_critics();
  void collect_drives(const Situation& situation);
  void collect_turns(const TwistWindow& window);
  std::optional<Twist2> back_off(const DwaScene& scene);
  std::optional<Twist2> turn(const DwaScene& scene, const std::optional<RatedTwist>& drive);
  std::optional<Twist2> best_turn(const DwaScene& scene, const std::optional<RatedTwist>& drive,
                                  const Twist2& any);
  bool leads_back(const Situation& situation) const;
  bool can_drive(const Situation& situation) const;
  std::optional<RatedTwist> short_drive(const DwaScene& scene);
  std::optional<Twist2> sideways(const DwaScene& scene);
  std::optional<Twist2> choose(const DwaScene& scene);
  void begin_escape_if_stuck(const RobotState& state);
  Proposal escaping(const DwaScene& scene);

  TrajectoryPlannerParams params_;
  ControlSetup setup_;
  TrajectorySearch search_;
  TrajectoryCritics critics_;
  TrajectoryCritics turn_critics_;  ///< That choose between turns on the spot.
  std::vector<Twist2> samples_;
  DeadEndEscape escape_;
  std::optional<Twist2> last_drive_;  ///< Chosen in the last call; a turn is outside of the window.
};

MotionLimits TrajectoryPlannerLaw::limits(const MotionLimits& robot) const {
  MotionLimits limits = robot;
  limits.vx_min = std::min(limits.vx_min, params_.escape_vel);
  if (!params_.holonomic_robot.value_or(false) || limits.vy_max > 0.0) return limits;
  for (const double vy : params_.y_vels) limits.vy_max = std::max(limits.vy_max, std::fabs(vy));
  limits.ay_max = params_.acc_lim_y.value_or(limits.ax_max);
  return limits;
}

ControlSetup TrajectoryPlannerLaw::with_limits(ControlSetup setup) const {
  MotionLimits& limited = setup.limits;
  limited = limits(limited);
  cap_limit(params_.max_vel_x, &limited.vx_max);
  cap_limit(params_.max_vel_theta, &limited.wz_max);
  cap_limit(params_.acc_lim_x, &limited.ax_max);
  cap_limit(params_.acc_lim_x, &limited.decel_max);
  cap_limit(params_.acc_lim_y, &limited.ay_max);
  cap_limit(params_.acc_lim_theta, &limited.alpha_max);
  return setup;
}

void TrajectoryPlannerLaw::add_critics() {
  const GridUnit unit = params_.meter_scoring ? GridUnit::kMeters : GridUnit::kCells;
  const double path = params_.path_distance_bias;
  const double goal = params_.goal_distance_bias;
  constexpr Aggregation kLast = Aggregation::kLast;
  critics_.push_back(make_oscillation_critic(
      1.0, {params_.oscillation_reset_dist, params_.escape_reset_theta, -1.0}));
  critics_.push_back(make_moving_obstacle_critic(params_.moving_obstacle_scale, search_.dt_s()));
  critics_.push_back(make_obstacle_critic(params_.occdist_scale, kLast));
  if (params_.simple_attractor) {
    critics_.push_back(make_attractor_critic(goal));
  } else {
    critics_.push_back(make_grid_critic(GridKind::kPath, path, 0.0, 0.0, kLast, unit));
    critics_.push_back(make_grid_critic(GridKind::kGoal, goal, 0.0, 0.0, kLast, unit));
  }
  if (params_.heading_scoring) {
    constexpr double kHeadingScale = 0.3;  // upstream's
    const double step = std::ceil(params_.heading_scoring_timestep / search_.dt_s());
    critics_.push_back(make_heading_critic(kHeadingScale, static_cast<int>(step)));
  }
  turn_critics_.push_back(make_grid_critic(GridKind::kGoal, 1.0, params_.heading_lookahead, 0.0,
                                           kLast, GridUnit::kCells));
  turn_critics_.push_back(make_grid_critic(GridKind::kPath, 1.0, params_.heading_lookahead, 0.0,
                                           kLast, GridUnit::kCells));
}

void TrajectoryPlannerLaw::collect_drives(const Situation& situation) {
  const double duration_s = params_.dwa ? setup_.period_s : params_.sim_time;
  TwistWindow window = reachable_window(setup_.limits, situation.state.twist, duration_s);
  const double stop =
      stopping_speed(distance_left(situation), setup_.limits.decel_max, setup_.period_s);
  const double slowest = std::min(params_.min_vel_x, stop);
  // Nothing faster than what can still stop at the goal, and nothing slower than what moves it.
  window.hi.vx = std::max(std::min(window.hi.vx, stop), slowest);
  window.lo.vx = std::clamp(window.lo.vx, slowest, window.hi.vx);
  window.lo.wz =
      std::max(window.lo.wz, std::min(params_.min_vel_theta.value_or(window.lo.wz), window.hi.wz));
  window.lo.vy = window.hi.vy = 0.0;
  samples_.clear();
  append_velocities(window, {params_.vx_samples, 1, params_.vtheta_samples, 0.0, 0.0, 0.0},
                    &samples_);
  // What was free of contact is so still, where few other samples are.
  if (!last_drive_) return;
  const auto is_within = [](double lo, double value, double hi) {
    return lo <= value && value <= hi;
  };
  if (is_within(window.lo.vx, last_drive_->vx, window.hi.vx) &&
      is_within(window.lo.wz, last_drive_->wz, window.hi.wz)) {
    samples_.push_back(*last_drive_);
  }
}

void TrajectoryPlannerLaw::collect_turns(const TwistWindow& window) {
  samples_.clear();
  const int count = std::max(params_.vtheta_samples, 2);
  const double least = std::min(params_.min_in_place_vel_theta, setup_.limits.wz_max);
  for (int i = 0; i < count; ++i) {
    const double wz = window.lo.wz + (window.hi.wz - window.lo.wz) * i / (count - 1);
    if (wz != 0.0)
      samples_.push_back({0.0, 0.0, std::copysign(std::max(std::fabs(wz), least), wz)});
  }
}

/// Backwards, the slower the less room there is; nothing where there is no room.
std::optional<Twist2> TrajectoryPlannerLaw::back_off(const DwaScene& scene) {
  constexpr double kAhead_s = 0.5;
  for (const auto& critic : critics_) critic->reset();
  for (const double share : {1.0, 0.5, kSlowest}) {
    const Twist2 back{share * params_.escape_vel, 0.0, 0.0};
    samples_.assign(1, back);
    if (search_.best(samples_, scene, critics_, kAhead_s)) return back;
  }
  escape_.end();
  return std::nullopt;
}

std::optional<Twist2> TrajectoryPlannerLaw::turn(const DwaScene& scene,
                                                 const std::optional<RatedTwist>& drive) {
  if (!setup_.can_turn_on_spot()) return std::nullopt;
  collect_turns(reachable_window(setup_.limits, scene.situation.state.twist,
                                 params_.dwa ? setup_.period_s : params_.sim_time));
  const auto any = search_.best(samples_, scene, critics_);
  if (!any || (drive && any->score > drive->score)) return std::nullopt;
  return best_turn(scene, drive, any->twist);
}

/// Of the samples the one that improves the heading most; `any` where nothing says which does. A
/// turn that does not improve it is made only where the robot cannot drive.
std::optional<Twist2> TrajectoryPlannerLaw::best_turn(const DwaScene& scene,
                                                      const std::optional<RatedTwist>& drive,
                                                      const Twist2& any) {
  const auto chosen = search_.best(samples_, scene, turn_critics_);
  if (!chosen) return any;
  samples_.assign(1, Twist2{});
  const auto standing = search_.best(samples_, scene, turn_critics_);
  if (drive && standing && chosen->score >= standing->score) return std::nullopt;
  return chosen->twist;
}

/// Whether forward is where only backwards was possible, and the path leads out of there.
bool TrajectoryPlannerLaw::leads_back(const Situation& situation) const {
  if (!escape_.is_near_dead_end()) return false;
  const Pose2& robot = situation.state.pose;
  const Pose2 ahead = situation.path.at(params_.heading_lookahead);
  return std::cos(robot.yaw) * (ahead.x - robot.x) + std::sin(robot.yaw) * (ahead.y - robot.y) <
         0.0;
}

bool TrajectoryPlannerLaw::can_drive(const Situation& situation) const {
  return !escape_.is_active() && !leads_back(situation);
}

/// Between obstacles the samples may all be in contact at their ends: then what is free for a
/// shorter time will do, in which the robot can still stop.
std::optional<RatedTwist> TrajectoryPlannerLaw::short_drive(const DwaScene& scene) {
  collect_drives(scene.situation);
  const double stop_s = setup_.limits.vx_max / setup_.limits.decel_max + 4.0 * setup_.period_s;
  for (double s = 0.5 * params_.sim_time; s >= stop_s; s *= 0.5) {
    if (const auto drive = search_.best(samples_, scene, critics_, s)) return drive;
  }
  return std::nullopt;
}

std::optional<Twist2> TrajectoryPlannerLaw::sideways(const DwaScene& scene) {
  constexpr double kForward = 0.1;  // upstream's [m/s]
  if (!(setup_.limits.vy_max > 0.0)) return std::nullopt;
  samples_.clear();
  for (const double vy : params_.y_vels) {
    samples_.push_back({0.0, vy, 0.0});
    samples_.push_back({std::min(kForward, setup_.limits.vx_max), vy, 0.0});
  }
  const auto chosen = search_.best(samples_, scene, critics_);
  return chosen ? std::optional<Twist2>(chosen->twist) : std::nullopt;
}

std::optional<Twist2> TrajectoryPlannerLaw::choose(const DwaScene& scene) {
  std::optional<RatedTwist> drive;
  const bool drives = can_drive(scene.situation);
  if (drives) {
    collect_drives(scene.situation);
    drive = search_.best(samples_, scene, critics_);
  }
  if (const auto turning = turn(scene, drive)) return turning;
  if (drives && !drive) drive = short_drive(scene);
  if (drive) return drive->twist;
  return sideways(scene);
}

/// What looks free and is not, as the guard sees it, is left backwards, too.
void TrajectoryPlannerLaw::begin_escape_if_stuck(const RobotState& state) {
  const bool is_stuck = escape_.update(state);
  if (is_stuck && params_.escape_vel < 0.0) escape_.begin(state, true);
}

/// Where no velocity is free of contact: backwards, if the robot may.
Proposal TrajectoryPlannerLaw::escaping(const DwaScene& scene) {
  if (!(params_.escape_vel < 0.0)) {
    return {{}, Failure::kBlocked, "Each velocity that can be reached leads to contact."};
  }
  escape_.begin(scene.situation.state);
  const auto back = back_off(scene);
  // Of a robot in contact only the guard knows whether it leaves that.
  return {back.value_or(Twist2{kSlowest * params_.escape_vel, 0.0, 0.0}), Failure::kNone, ""};
}

Proposal TrajectoryPlannerLaw::propose(const Situation& situation) {
  const double near_m =
      std::max(params_.heading_lookahead, 2.0 * setup_.tolerance.xy_goal_tolerance);
  if (const auto twist = straight_to_goal(situation, setup_, near_m)) {
    return {*twist, Failure::kNone, ""};
  }
  begin_escape_if_stuck(situation.state);
  const DwaScene scene = search_.begin(situation);
  if (escape_.is_straight()) {
    if (const auto back = back_off(scene)) return {*back, Failure::kNone, ""};
  }
  const auto chosen = choose(scene);
  last_drive_ = chosen;
  if (!chosen) return escaping(scene);
  for (const auto& critic : critics_) critic->on_chosen(scene, *chosen);
  search_.describe(*chosen, scene,
                   {false, params_.publish_cost_grid_pc, params_.path_distance_bias,
                    params_.goal_distance_bias, params_.occdist_scale});
  return {*chosen, Failure::kNone, ""};
}

}  // namespace

void add_trajectory_planner(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& params,
                                 const std::string& label) {
    return std::make_unique<TrajectoryPlannerLaw>(
        setup, load_config_node<TrajectoryPlannerParams>(params, label));
  };
  factory.fields = config_fields<TrajectoryPlannerParams>();
  registry.add("trajectory_planner", factory);
  registry.add("base_local_planner/TrajectoryPlannerROS", factory);
}

}  // namespace trident::nav
