// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "../config_split.h"
#include "../laws.h"
#include "../steering.h"
#include "rotation_shim_params.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_base/yaml_config.h"

namespace trident::nav {
namespace {

/// Turns on the spot until the robot faces its path, and leaves the rest to another law, as Nav2's
/// rotation shim does. A turn that is blocked to the nearer side is made to the other one; where
/// both are blocked, or the robot cannot turn on the spot, the other law decides.
class RotationShimLaw final : public ControlLaw {
 public:
  RotationShimLaw(const ControlSetup& setup, const RotationShimParams& params,
                  std::unique_ptr<ControlLaw> primary)
      : setup_(setup), params_(params), primary_(std::move(primary)) {
    turn_limits_ = setup.limits;
    turn_limits_.wz_max = std::min(
        turn_limits_.wz_max, params.rotate_to_heading_angular_vel.value_or(turn_limits_.wz_max));
    turn_limits_.alpha_max =
        std::min(turn_limits_.alpha_max, params.max_angular_accel.value_or(turn_limits_.alpha_max));
  }

  MotionLimits limits(const MotionLimits& robot) const override { return primary_->limits(robot); }
  double path_length_m() const override {
    return std::max(primary_->path_length_m(), 2.0 * params_.forward_sampling_distance);
  }
  Proposal propose(const Situation& situation) override;
  void on_sent(const Twist2& twist) override {
    sent_ = twist;
    primary_->on_sent(twist);
  }
  void reset() override {
    primary_->reset();
    is_turning_ = false;
    has_turned_ = false;
    sent_ = {};
  }

 private:
  std::optional<double> angle_off(const Situation& situation) const;
  bool may_turn() const {
    return setup_.can_turn_on_spot() && !(params_.rotate_to_heading_once && has_turned_);
  }
  std::optional<double> angle_to_turn(const Situation& situation) const;
  bool is_turn_free(const Situation& situation, double angle) const;
  Twist2 turn(const RobotState& state, double angle) const;

  ControlSetup setup_;
  RotationShimParams params_;
  std::unique_ptr<ControlLaw> primary_;
  MotionLimits turn_limits_;
  bool is_turning_ = false;
  bool has_turned_ = false;  ///< For this goal.
  Twist2 sent_;
};

// From the robot's heading to what it should be; nothing where the goal is too near for a
// direction.
std::optional<double> RotationShimLaw::angle_off(const Situation& situation) const {
  const Pose2& pose = situation.state.pose;
  const LocalPath& path = situation.path;
  const Point2 point = lookahead_point(path, pose, params_.forward_sampling_distance);
  if (distance(point.x, point.y, pose.x, pose.y) <= setup_.tolerance.xy_goal_tolerance) {
    return std::nullopt;
  }
  if (params_.use_path_orientations && path.has_headings) {
    const double place = params_.forward_sampling_distance / path.spacing_m;
    const double last = static_cast<double>(path.headings.size() - 1);
    const auto i = static_cast<std::size_t>(std::min(place, last));
    return wrap_angle(path.headings[i] - pose.yaw);
  }
  const bool reverses = path.is_reverse && setup_.limits.vx_min < 0.0;
  const double bearing = std::atan2(point.y - pose.y, point.x - pose.x);
  return wrap_angle(bearing + (reverses ? kPi : 0.0) - pose.yaw);
}

bool RotationShimLaw::is_turn_free(const Situation& situation, double angle) const {
  constexpr double kStep = 0.05;  // [rad]
  const Pose2& pose = situation.state.pose;
  const double reach =
      std::min(std::fabs(angle), turn_limits_.wz_max * params_.simulate_ahead_time);
  const int steps = 1 + static_cast<int>(reach / kStep);
  for (int i = 1; i <= steps; ++i) {
    const double yaw = wrap_angle(pose.yaw + std::copysign(reach * i / steps, angle));
    if (!situation.checker.is_free(situation.grid, {pose.x, pose.y, yaw})) return false;
  }
  return true;
}

Twist2 RotationShimLaw::turn(const RobotState& state, double angle) const {
  const double now = params_.closed_loop ? state.twist.wz : sent_.wz;
  const double change = turn_limits_.alpha_max * setup_.period_s;
  const double wanted = turning_rate(turn_limits_, angle, setup_.period_s);
  return {0.0, 0.0, std::clamp(wanted, now - change, now + change)};
}

// What is worth a turn on the spot.
std::optional<double> RotationShimLaw::angle_to_turn(const Situation& situation) const {
  const auto angle = may_turn() ? angle_off(situation) : std::nullopt;
  const double threshold =
      is_turning_ ? params_.angular_disengage_threshold : params_.angular_dist_threshold;
  return angle && std::fabs(*angle) > threshold ? angle : std::nullopt;
}

Proposal RotationShimLaw::propose(const Situation& situation) {
  const std::optional<double> angle = angle_to_turn(situation);
  is_turning_ = angle.has_value();
  if (!is_turning_) {
    has_turned_ = true;
    return primary_->propose(situation);
  }
  const double far = *angle - std::copysign(2.0 * kPi, *angle);
  for (const double turned : {*angle, far}) {
    if (is_turn_free(situation, turned)) return {turn(situation.state, turned), Failure::kNone, ""};
  }
  return primary_->propose(situation);
}

// Keys that only the shim knows do not reach the other law; those that both have reach both.
std::unique_ptr<ControlLaw> make_primary(const std::string& name, const ControlSetup& setup,
                                         const ConfigNode& own, ConfigNode given,
                                         const std::string& label) {
  const ControlLawRegistry registry = builtin_control_laws();
  const ControlLawFactory& factory = registry.get(controller_name(name));
  for (std::size_t i = 0; i < own.keys.size(); ++i) {
    ConfigNode one;
    put_key(&one, own.keys[i], own.key_lines[i], own.items[i]);
    try {
      factory(setup, one, label);
    } catch (const ConfigError&) {
      continue;
    }
    put_key(&given, own.keys[i], own.key_lines[i], own.items[i]);
  }
  return factory(setup, given, label);
}

}  // namespace

void RotationShimParams::validate() const {
  if (angular_disengage_threshold > angular_dist_threshold) {
    throw Error("angular_disengage_threshold: " + number_text(angular_disengage_threshold) +
                " rad is greater than angular_dist_threshold, " +
                number_text(angular_dist_threshold) + " rad");
  }
}

void add_rotation_shim(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& params,
                                 const std::string& label) {
    ConfigNode rest = params;
    const ConfigNode own = take_keys(&rest, key_names<RotationShimParams>());
    const auto shim = load_config_node<RotationShimParams>(own, label);
    const std::string& name = shim.primary_controller;
    if (name == "rotation_shim" || name.find("RotationShimController") != std::string::npos) {
      throw ConfigError(label, own.line, "primary_controller",
                        "'" + name + "' cannot be its own primary controller");
    }
    auto primary = make_primary(name, setup, own, std::move(rest), label);
    return std::make_unique<RotationShimLaw>(setup, shim, std::move(primary));
  };
  factory.fields = config_fields<RotationShimParams>();
  registry.add("rotation_shim", factory);
  registry.add("nav2_rotation_shim_controller::RotationShimController", factory);
}

}  // namespace trident::nav
