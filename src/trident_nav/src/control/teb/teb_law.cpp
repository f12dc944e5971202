// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../laws.h"
#include "../mppi/obstacle_survey.h"
#include "../steering.h"
#include "teb_planner.h"
#include "trident_base/angle.h"
#include "trident_base/yaml_config.h"

namespace trident::nav {
namespace {

/// Follows timed elastic bands: poses and durations that are optimized together, in several
/// homotopy classes. Rösmann et al. 2012, 2013 and 2017.
class TebLaw final : public ControlLaw {
 public:
  TebLaw(const ControlSetup& setup, const TebParams& params)
      : setup_(setup), model_(params, setup), planner_(model_, setup.unknown) {}

  MotionLimits limits(const MotionLimits& robot) const override {
    MotionLimits limits = robot;
    limits.vx_min = std::min(robot.vx_min, model_.limits.vx_min);
    return limits;
  }
  double path_length_m() const override {
    return (is_short_ ? kShortShare : 1.0) * model_.params.max_global_plan_lookahead_dist;
  }
  Proposal propose(const Situation& situation) override;
  void reset() override {
    planner_.reset();
    is_short_ = false;
  }

 private:
  static constexpr double kShortShare = 0.5;

  Twist2 first_motion(const TebBand& band) const;
  Twist2 command_of(const Situation& situation, const TebBand& band) const;
  Proposal without_band(const Situation& situation);

  ControlSetup setup_;
  TebModel model_;
  TebPlanner planner_;
  GridWithDistances distances_;
  bool is_short_ = false;
  double shortened_s_ = 0.0;
};

// The mean motion to the pose of the band that the parameters look ahead to.
Twist2 TebLaw::first_motion(const TebBand& band) const {
  const auto kept = static_cast<std::size_t>(model_.params.prevent_look_ahead_poses_near_goal);
  const std::size_t last = band.size() - 1 - std::min(kept, band.size() - 2);
  const auto ahead = static_cast<std::size_t>(model_.params.control_look_ahead_poses);
  const std::size_t end = std::min(ahead, last);
  double time_s = 0.0;
  for (std::size_t i = 0; i < end; ++i) time_s += band[i].dt_s;
  const SegmentMotion motion = segment_motion(band[0], band[end], ArcLength::kExact);
  Twist2 twist{motion.along.value / time_s, 0.0, motion.turn.value / time_s};
  if (model_.is_holonomic) twist.vy = motion.across.value / time_s;
  return twist;
}

Twist2 TebLaw::command_of(const Situation& situation, const TebBand& band) const {
  Twist2 twist = first_motion(band);
  // The robot that is not yet as fast keeps the curvature.
  const TwistWindow& window = situation.window;
  const double reached = std::clamp(twist.vx, window.lo.vx, window.hi.vx);
  if (reached * twist.vx > 0.0 && std::fabs(reached) < std::fabs(twist.vx)) {
    twist.wz *= reached / twist.vx;
    twist.vx = reached;
  }
  if (!situation.path.reaches_goal || model_.params.free_goal_vel) return twist;
  // Whatever the band hopes for, the robot must be able to stop at the goal.
  return slowed_to(
      stopping_speed(distance_left(situation), model_.limits.decel_max, setup_.period_s), twist);
}

/// Where no band is free: a turn toward the path, if the robot can turn there.
Proposal TebLaw::without_band(const Situation& situation) {
  if (model_.params.shrink_horizon_backup) {
    is_short_ = true;
    shortened_s_ = situation.state.time_s;
  }
  const Pose2& pose = situation.state.pose;
  const Point2 ahead =
      to_base(pose, lookahead_point(situation.path, pose, setup_.footprint.circumscribed_radius));
  const double angle = std::atan2(ahead.y, ahead.x);
  constexpr double kAligned = 0.15;  // [rad]
  if (setup_.can_turn_on_spot() && std::fabs(angle) > kAligned) {
    return {{0.0, 0.0, turning_rate(model_.limits, angle, setup_.period_s)}, Failure::kNone, ""};
  }
  return {{}, Failure::kBlocked, "No timed elastic band along the path ahead is free of contact."};
}

Proposal TebLaw::propose(const Situation& situation) {
  const double near_m = 2.0 * setup_.tolerance.xy_goal_tolerance;
  if (const auto twist = straight_to_goal(situation, setup_, near_m)) {
    return {*twist, Failure::kNone, ""};
  }
  const double short_s = situation.state.time_s - shortened_s_;
  if (is_short_ && short_s > model_.params.shrink_horizon_min_duration) is_short_ = false;
  const TebBand* const band = planner_.plan(situation, distances_.of(situation.grid));
  if (situation.watched.trajectories) {
    planner_.describe(situation.details);
    situation.details->wants_feedback = model_.params.publish_feedback;
  }
  if (band == nullptr) return without_band(situation);
  return {command_of(situation, *band), Failure::kNone, ""};
}

}  // namespace

void add_teb(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& params,
                                 const std::string& label) {
    return std::make_unique<TebLaw>(setup, load_config_node<TebParams>(params, label));
  };
  factory.fields = config_fields<TebParams>();
  registry.add("teb", factory);
  registry.add("teb_local_planner/TebLocalPlannerROS", factory);
}

}  // namespace trident::nav
