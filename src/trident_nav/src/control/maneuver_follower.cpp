// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "maneuver_follower.h"

#include <algorithm>
#include <cmath>

#include "steering.h"

namespace trident::nav {
namespace {

// Farther off the path, or turned more, arcs from where the robot is do not lead back in time.
constexpr double kMaxDeviation = 0.13;  // of the least turning radius
constexpr double kMaxTurned = 0.4;      // [rad]

// While the wheels turn for another curvature, the robot does not quite stand: a steering angle is
// commanded by a turn rate, which a speed belongs to.
constexpr double kCreep_m_s = 0.004;
constexpr double kSteering_s = 0.25;
constexpr double kSteeredShare = 0.25;  // of the greatest curvature: a smaller change needs no wait

// The distance over which a deviation decays: of the least turning radius, or of the speed.
constexpr double kDecay = 0.2;
constexpr double kDecay_s = 0.5;

double room_m(const Situation& situation) {
  return clearance_m(situation.grid, situation.state.pose, situation.checker.footprint(), 1.0);
}

}  // namespace

ManeuverFollower::ManeuverFollower(const ControlSetup& setup)
    : setup_(setup), reach_m_(2.0 * setup.limits.min_turning_radius) {}

bool ManeuverFollower::is_needed(const ControlSetup& setup) {
  return !setup.can_turn_on_spot() && setup.limits.min_turning_radius > 0.0 &&
         setup.limits.vx_min < 0.0;
}

void ManeuverFollower::reset() { *this = ManeuverFollower(setup_); }

bool ManeuverFollower::is_near_cusp(const LocalPath& path) const {
  // The last part of a maneuver is followed to the goal.
  const bool is_last = std::isfinite(driven_m_) && path.remaining_m <= reach_m_;
  return path.ends_at_cusp || driven_m_ <= reach_m_ || is_last;
}

void ManeuverFollower::note_motion(const Situation& situation, int gear) {
  const Pose2& pose = situation.state.pose;
  if (last_pose_) driven_m_ += distance(last_pose_->x, last_pose_->y, pose.x, pose.y);
  if (gear_ != 0 && gear != gear_) driven_m_ = 0.0;
  last_pose_ = pose;
  gear_ = gear;
}

/// Ends at the part's end, and is the lower the less room there is.
double ManeuverFollower::speed(const Situation& situation) const {
  constexpr double kMin_m_s = 0.1, kRoomGain = 1.0;
  const LocalPath& path = situation.path;
  const MotionLimits& limits = setup_.limits;
  const double most_m_s = path.is_reverse ? -limits.vx_min : limits.vx_max;
  const double safe_m_s = std::max(kMin_m_s, kRoomGain * room_m(situation));
  const double left_m = path.length_m();
  double v = std::min(most_m_s, safe_m_s);
  if (path.ends_at_cusp || path.reaches_goal) {
    v = std::min(
        {v, stopping_speed(left_m, limits.decel_max, setup_.period_s), left_m / setup_.period_s});
  }
  return std::max(v, 0.0);
}

/// The curvature that leads back to the path, and along it; nothing from too far off.
std::optional<double> ManeuverFollower::curvature_to(const Situation& situation, double v) const {
  const LocalPath& path = situation.path;
  const double radius_m = setup_.limits.min_turning_radius;
  const Pose2& pose = situation.state.pose;
  const Pose2& on_path = path.poses.front();
  const double turned = wrap_angle(pose.yaw - path.heading);
  const double off_m =
      std::cos(on_path.yaw) * (pose.y - on_path.y) - std::sin(on_path.yaw) * (pose.x - on_path.x);
  if (std::fabs(off_m) > kMaxDeviation * radius_m || std::fabs(turned) > kMaxTurned) {
    return std::nullopt;
  }
  const double decay_m = std::max(kDecay * radius_m, kDecay_s * v);
  const double wanted =
      path.curvature - off_m / (decay_m * decay_m) - 2.0 * std::sin(turned) / decay_m;
  return std::clamp(wanted, -1.0 / radius_m, 1.0 / radius_m);
}

/// Whether the robot has to wait for its wheels, which turn for a steering: the turn rate by the
/// speed [1/m].
bool ManeuverFollower::is_steering(const Situation& situation, double steering) {
  const double time_s = situation.state.time_s;
  if (std::fabs(steering - steering_) * setup_.limits.min_turning_radius > kSteeredShare) {
    steered_s_ = time_s + kSteering_s;
  }
  steering_ = steering;
  // What rolls on as before the change of gear stops first.
  const bool stands = gear_ * situation.state.twist.vx < 2.0 * kCreep_m_s;
  return stands && time_s < steered_s_;
}

std::optional<Twist2> ManeuverFollower::follow(const Situation& situation) {
  const LocalPath& path = situation.path;
  if (!path.has_headings || path.headings.size() < 2) return std::nullopt;
  note_motion(situation, path.is_reverse ? -1 : 1);
  if (!is_near_cusp(path)) return std::nullopt;
  double v = speed(situation);
  const auto curvature = curvature_to(situation, v);
  if (!curvature) return std::nullopt;
  if (is_steering(situation, gear_ * *curvature)) v = std::min(v, kCreep_m_s);
  return Twist2{gear_ * v, 0.0, v * *curvature};
}

}  // namespace trident::nav
