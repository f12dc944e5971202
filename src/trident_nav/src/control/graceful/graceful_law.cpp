// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "../laws.h"
#include "../steering.h"
#include "graceful_params.h"
#include "smooth_law.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_base/yaml_config.h"

namespace trident::nav {
namespace {

// A pose of the path that the robot is led to.
struct Target {
  Pose2 pose;  ///< With the robot's heading there.
  bool is_backward = false;
};

/// Graceful motion: a law that leads to a pose and its heading on a smooth curve, applied to the
/// farthest pose of the path to which that curve is free of contact, as Nav2's graceful controller
/// does.
class GracefulLaw final : public ControlLaw {
 public:
  GracefulLaw(const ControlSetup& setup, const GracefulParams& params)
      : setup_(with_limits(setup, params)), params_(params) {}

  double path_length_m() const override { return params_.max_lookahead; }
  Proposal propose(const Situation& situation) override;
  void reset() override { is_turning_ = false; }

 private:
  static ControlSetup with_limits(ControlSetup setup, const GracefulParams& params);
  bool is_driven_backward(const Pose2& robot, const Pose2& target) const;
  Target target_at(const Situation& situation, double arc_m) const;
  std::optional<Target> free_target(const Situation& situation) const;
  double off_by(const Pose2& pose, const Target& target) const;
  bool must_turn(double angle) const;
  double curvature(const Pose2& pose, const Target& target) const;
  bool is_turn_free(const Situation& situation, double angle) const;
  bool is_drive_free(const Situation& situation, const Target& target, Pose2 pose) const;
  bool is_motion_free(const Situation& situation, const Target& target) const;
  Proposal aligned_with_path(const Situation& situation) const;
  double speed(const Situation& situation, double curvature) const;
  Twist2 turn(double angle) const;

  ControlSetup setup_;
  GracefulParams params_;
  bool is_turning_ = false;
};

ControlSetup GracefulLaw::with_limits(ControlSetup setup, const GracefulParams& params) {
  MotionLimits& limits = setup.limits;
  limits.vx_max = std::min(limits.vx_max, params.v_linear_max.value_or(limits.vx_max));
  limits.wz_max = std::min(limits.wz_max, params.v_angular_max.value_or(limits.wz_max));
  return setup;
}

bool GracefulLaw::is_driven_backward(const Pose2& robot, const Pose2& target) const {
  if (!params_.allow_backward || !(setup_.limits.vx_min < 0.0)) return false;
  const double bearing = std::atan2(target.y - robot.y, target.x - robot.x);
  return std::fabs(wrap_angle(bearing - robot.yaw)) > 0.5 * kPi;
}

Target GracefulLaw::target_at(const Situation& situation, double arc_m) const {
  const LocalPath& path = situation.path;
  Target target{path.at(arc_m), false};
  target.is_backward = is_driven_backward(situation.state.pose, target.pose);
  if (target.is_backward) target.pose.yaw = wrap_angle(target.pose.yaw + kPi);
  const bool is_goal = path.reaches_goal && arc_m >= path.length_m();
  if (is_goal && !params_.prefer_final_rotation) target.pose.yaw = situation.goal.yaw;
  return target;
}

double GracefulLaw::off_by(const Pose2& pose, const Target& target) const {
  return -egocentric(pose, target.pose, target.is_backward).delta;
}

bool GracefulLaw::must_turn(double angle) const {
  // A turn once begun ends well within the angle that began it.
  constexpr double kEnd = 0.25;
  const double begin = params_.initial_rotation_tolerance;
  return params_.initial_rotation && setup_.can_turn_on_spot() &&
         std::fabs(angle) > (is_turning_ ? kEnd * begin : begin);
}

double GracefulLaw::curvature(const Pose2& pose, const Target& target) const {
  const double wanted = smooth_curvature(egocentric(pose, target.pose, target.is_backward),
                                         {params_.k_phi, params_.k_delta});
  const double radius_m = setup_.limits.min_turning_radius;
  return radius_m > 0.0 ? std::clamp(wanted, -1.0 / radius_m, 1.0 / radius_m) : wanted;
}

bool GracefulLaw::is_turn_free(const Situation& situation, double angle) const {
  const Pose2& pose = situation.state.pose;
  const int steps = 1 + static_cast<int>(std::fabs(angle) / params_.in_place_collision_resolution);
  for (int i = 1; i <= steps; ++i) {
    const double yaw = wrap_angle(pose.yaw + angle * i / steps);
    if (!situation.checker.is_free(situation.grid, {pose.x, pose.y, yaw})) return false;
  }
  return true;
}

// Drives the law from a pose to the target.
bool GracefulLaw::is_drive_free(const Situation& situation, const Target& target,
                                Pose2 pose) const {
  const double step_m = situation.grid.geometry.resolution;
  constexpr double kMaxTurn = 0.5;  // of a step, for the integration [rad]
  constexpr double kDetour = 3.0;   // longer than straight: it does not arrive
  double left_m = distance(pose.x, pose.y, target.pose.x, target.pose.y);
  const int steps = 1 + static_cast<int>(kDetour * left_m / step_m);
  for (int i = 0; i < steps && left_m > step_m; ++i) {
    const double bend = std::clamp(curvature(pose, target) * step_m, -kMaxTurn, kMaxTurn);
    const double along_m = target.is_backward ? -step_m : step_m;
    pose = integrate(pose, {along_m, 0.0, bend}, 1.0);
    if (!situation.checker.is_free(situation.grid, pose)) return false;
    left_m = distance(pose.x, pose.y, target.pose.x, target.pose.y);
  }
  return left_m <= step_m;
}

// Drives the law to the target, a turn on the spot before it included.
bool GracefulLaw::is_motion_free(const Situation& situation, const Target& target) const {
  Pose2 pose = situation.state.pose;
  const double angle = off_by(pose, target);
  if (must_turn(angle)) {
    if (!is_turn_free(situation, angle)) return false;
    pose.yaw = wrap_angle(pose.yaw + angle);
  }
  return is_drive_free(situation, target, pose);
}

std::optional<Target> GracefulLaw::free_target(const Situation& situation) const {
  const double longest_m = std::min(params_.max_lookahead, situation.path.length_m());
  const double shortest_m = std::min(params_.min_lookahead, longest_m);
  const double step_m = 2.0 * situation.grid.geometry.resolution;
  for (double arc_m = longest_m; arc_m >= shortest_m; arc_m -= step_m) {
    const Target target = target_at(situation, arc_m);
    if (!params_.use_collision_detection || is_motion_free(situation, target)) return target;
  }
  const Target nearest = target_at(situation, shortest_m);
  return is_motion_free(situation, nearest) ? std::optional<Target>(nearest) : std::nullopt;
}

double GracefulLaw::speed(const Situation& situation, double curvature) const {
  const double bend = std::pow(std::fabs(curvature), params_.lambda);
  const double left_m = distance_left(situation);
  double speed = setup_.limits.vx_max / (1.0 + params_.beta * bend);
  speed = std::min(speed, setup_.limits.vx_max * left_m / params_.slowdown_radius);
  speed = std::max(speed, std::min(params_.v_linear_min, setup_.limits.vx_max));
  const double stop = stopping_speed(left_m, setup_.limits.decel_max, setup_.period_s);
  return std::min({speed, stop, setup_.limits.wz_max / std::max(std::fabs(curvature), 1e-9)});
}

Twist2 GracefulLaw::turn(double angle) const {
  const double most = std::fabs(turning_rate(setup_.limits, angle, setup_.period_s));
  const double scaled = params_.rotation_scaling_factor * std::fabs(angle) * setup_.limits.wz_max;
  const double rate = std::min(std::max(scaled, params_.v_angular_min_in_place), most);
  return {0.0, 0.0, std::copysign(rate, angle)};
}

// Where no curve is free: a turn toward what is next on the path.
Proposal GracefulLaw::aligned_with_path(const Situation& situation) const {
  constexpr double kAligned = 0.1;  // [rad]
  const double angle = off_by(situation.state.pose, target_at(situation, params_.min_lookahead));
  if (setup_.can_turn_on_spot() && std::fabs(angle) > kAligned && is_turn_free(situation, angle)) {
    return {turn(angle), Failure::kNone, ""};
  }
  return {{}, Failure::kBlocked, "No curve to a pose of the path ahead is free of contact."};
}

Proposal GracefulLaw::propose(const Situation& situation) {
  if (params_.prefer_final_rotation) {
    const double near_m = std::max(params_.min_lookahead, 2.0 * setup_.tolerance.xy_goal_tolerance);
    const auto twist = straight_to_goal(situation, setup_, near_m);
    if (twist) return {*twist, Failure::kNone, ""};
  }
  const Pose2& pose = situation.state.pose;
  const auto target = free_target(situation);
  if (!target) return aligned_with_path(situation);
  const double angle = off_by(pose, *target);
  is_turning_ = must_turn(angle);
  if (is_turning_) return {turn(angle), Failure::kNone, ""};
  const double bend = curvature(pose, *target);
  const double v = speed(situation, bend);
  const double signed_v = target->is_backward ? std::max(-v, setup_.limits.vx_min) : v;
  return {{signed_v, 0.0, std::fabs(signed_v) * bend}, Failure::kNone, ""};
}

}  // namespace

void GracefulParams::validate() const {
  if (min_lookahead > max_lookahead) {
    throw Error("min_lookahead: " + number_text(min_lookahead) +
                " m is greater than max_lookahead, " + number_text(max_lookahead) + " m");
  }
}

void add_graceful(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& params,
                                 const std::string& label) {
    return std::make_unique<GracefulLaw>(setup, load_config_node<GracefulParams>(params, label));
  };
  factory.fields = config_fields<GracefulParams>();
  registry.add("graceful", factory);
  registry.add("nav2_graceful_controller::GracefulController", factory);
}

}  // namespace trident::nav
