// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "../laws.h"
#include "../steering.h"
#include "pure_pursuit_params.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/control/control_law.h"

namespace trident::nav {
namespace {

// A point to steer for and the arc that leads there.
struct Carrot {
  Point2 in_base;  // [m]
  double distance_m = 0.0;
  double curvature = 0.0;  // [1/m], positive to the left
};

/// Regulated pure pursuit: the arc through a point of the path ahead, slower in curves, near
/// obstacles and before the goal. Coulter, "Implementation of the pure pursuit path tracking
/// algorithm", CMU-RI-TR-92-01; Macenski et al., "Regulated pure pursuit for robot path tracking",
/// Autonomous Robots 47 (2023). Where the arc is blocked the carrot comes nearer, down to the
/// robot's radius, so that corners are not cut.
class PurePursuitLaw final : public ControlLaw {
 public:
  PurePursuitLaw(const ControlSetup& setup, const PurePursuitParams& params)
      : setup_(setup), params_(params) {}

  double path_length_m() const override {
    return 2.0 * std::max(params_.lookahead_dist, params_.max_lookahead_dist);
  }
  Proposal propose(const Situation& situation) override;
  void reset() override { is_turning_ = false; }

 private:
  double lookahead_m(double speed) const;
  Carrot carrot_at(const Situation& situation, double lookahead_m) const;
  bool is_arc_free(const Situation& situation, const Carrot& carrot, double margin_m) const;
  bool must_turn(const Carrot& carrot) const;
  std::optional<Carrot> free_carrot(const Situation& situation) const;
  double angle_to(const Situation& situation, const Carrot& carrot) const;
  std::optional<Twist2> turn_on_spot(const Situation& situation, const Carrot& carrot,
                                     double begin_angle);
  Proposal aligned_with_path(const Situation& situation);
  bool reverses_to(const Carrot& carrot) const;
  double regulated_speed(const Situation& situation, const Carrot& carrot) const;
  double curvature_for_speed(const Situation& situation, const Carrot& carrot) const;

  ControlSetup setup_;
  PurePursuitParams params_;
  bool is_turning_ = false;
};

double PurePursuitLaw::lookahead_m(double speed) const {
  if (!params_.use_velocity_scaled_lookahead_dist) return params_.lookahead_dist;
  return std::clamp(std::fabs(speed) * params_.lookahead_time, params_.min_lookahead_dist,
                    params_.max_lookahead_dist);
}

Carrot PurePursuitLaw::carrot_at(const Situation& situation, double lookahead_m) const {
  const Point2 p = lookahead_point(situation.path, situation.state.pose, lookahead_m);
  Carrot carrot;
  carrot.in_base = to_base(situation.state.pose, p);
  carrot.distance_m = std::hypot(carrot.in_base.x, carrot.in_base.y);
  const double square = std::max(carrot.distance_m * carrot.distance_m, 1e-6);
  carrot.curvature = 2.0 * carrot.in_base.y / square;
  return carrot;
}

bool PurePursuitLaw::is_arc_free(const Situation& situation, const Carrot& carrot,
                                 double margin_m) const {
  if (!params_.use_collision_detection) return true;
  const double sign = carrot.in_base.x < 0.0 ? -1.0 : 1.0;
  const double speed =
      std::max(std::fabs(situation.state.twist.vx), params_.regulated_linear_scaling_min_speed);
  const double reach_m =
      std::min(carrot.distance_m, speed * params_.max_allowed_time_to_collision_up_to_carrot);
  return is_arc_clear(situation, sign, sign * carrot.curvature, reach_m, margin_m);
}

bool PurePursuitLaw::must_turn(const Carrot& carrot) const {
  if (!params_.use_rotate_to_heading || !setup_.can_turn_on_spot()) return false;
  const double angle = std::fabs(std::atan2(carrot.in_base.y, carrot.in_base.x));
  return angle > params_.rotate_to_heading_min_angle;
}

std::optional<Carrot> PurePursuitLaw::free_carrot(const Situation& situation) const {
  constexpr double kShrink = 0.8;
  const double longest_m = lookahead_m(situation.state.twist.vx);
  const double shortest_m = std::min(setup_.footprint.circumscribed_radius, longest_m);
  // With a cell of room to spare if that can be had.
  for (const double margin_m : {situation.grid.geometry.resolution, 0.0}) {
    double length_m = longest_m;
    while (true) {
      const Carrot carrot = carrot_at(situation, length_m);
      if (must_turn(carrot) || is_arc_free(situation, carrot, margin_m)) return carrot;
      if (length_m <= shortest_m) break;
      length_m = std::max(kShrink * length_m, shortest_m);
    }
  }
  return std::nullopt;
}

// From the robot's heading to a carrot, to which it may drive backwards.
double PurePursuitLaw::angle_to(const Situation& situation, const Carrot& carrot) const {
  const bool reverses = params_.allow_reversing && situation.path.is_reverse;
  return reverses ? std::atan2(-carrot.in_base.y, -carrot.in_base.x)
                  : std::atan2(carrot.in_base.y, carrot.in_base.x);
}

std::optional<Twist2> PurePursuitLaw::turn_on_spot(const Situation& situation, const Carrot& carrot,
                                                   double begin_angle) {
  if (!params_.use_rotate_to_heading || !setup_.can_turn_on_spot()) return std::nullopt;
  const double toward = angle_to(situation, carrot);
  // A turn once begun ends well within the angle that began it.
  constexpr double kEnd = 0.25;
  is_turning_ = std::fabs(toward) > (is_turning_ ? kEnd * begin_angle : begin_angle);
  if (!is_turning_) return std::nullopt;
  MotionLimits limits = setup_.limits;
  limits.wz_max =
      std::min(limits.wz_max, params_.rotate_to_heading_angular_vel.value_or(limits.wz_max));
  limits.alpha_max =
      std::min(limits.alpha_max, params_.max_angular_accel.value_or(limits.alpha_max));
  return Twist2{0.0, 0.0, turning_rate(limits, toward, setup_.period_s)};
}

double PurePursuitLaw::curvature_for_speed(const Situation& situation, const Carrot& carrot) const {
  if (!params_.use_fixed_curvature_lookahead) return carrot.curvature;
  return carrot_at(situation, params_.curvature_lookahead_dist).curvature;
}

double PurePursuitLaw::regulated_speed(const Situation& situation, const Carrot& carrot) const {
  const double desired =
      std::min(params_.desired_linear_vel.value_or(setup_.limits.vx_max), setup_.limits.vx_max);
  double speed = desired;
  const double curvature = std::fabs(curvature_for_speed(situation, carrot));
  const double radius_m = 1.0 / std::max(curvature, 1e-9);
  if (params_.use_regulated_linear_velocity_scaling) {
    speed *= std::min(1.0, radius_m / params_.regulated_linear_scaling_min_radius);
  }
  if (params_.use_cost_regulated_linear_velocity_scaling) {
    const double clear_m = clearance_m(situation.grid, situation.state.pose, setup_.footprint,
                                       params_.inflation_cost_scaling_factor);
    const double share = params_.cost_scaling_gain * clear_m / params_.cost_scaling_dist;
    speed = std::min(speed, desired * std::clamp(share, 0.0, 1.0));
  }
  speed = std::max(speed, std::min(desired, params_.regulated_linear_scaling_min_speed));
  const double left_m = distance_left(situation);
  if (left_m < params_.approach_velocity_scaling_dist) {
    speed *= left_m / params_.approach_velocity_scaling_dist;
    speed = std::max(speed, std::min(desired, params_.min_approach_linear_velocity));
  }
  const double stop = stopping_speed(left_m, setup_.limits.decel_max, setup_.period_s);
  // What the turn rate allows on this arc.
  return std::min({speed, stop, setup_.limits.wz_max * radius_m});
}

// Where no carrot is free: a turn toward what is next on the path.
Proposal PurePursuitLaw::aligned_with_path(const Situation& situation) {
  constexpr double kAligned = 0.1;  // [rad]
  const Carrot blocked = carrot_at(situation, setup_.footprint.circumscribed_radius);
  const auto aligning = turn_on_spot(situation, blocked, kAligned);
  if (aligning) return {*aligning, Failure::kNone, ""};
  return {{}, Failure::kBlocked, "The arc to the lookahead point is blocked by an obstacle."};
}

bool PurePursuitLaw::reverses_to(const Carrot& carrot) const {
  const bool is_behind = std::fabs(std::atan2(carrot.in_base.y, carrot.in_base.x)) > 0.5 * kPi;
  return setup_.limits.vx_min < 0.0 && is_behind &&
         (params_.allow_reversing || !setup_.can_turn_on_spot());
}

Proposal PurePursuitLaw::propose(const Situation& situation) {
  const std::optional<Carrot> carrot = free_carrot(situation);
  if (!carrot) return aligned_with_path(situation);
  const auto turn = turn_on_spot(situation, *carrot, params_.rotate_to_heading_min_angle);
  if (turn) return {*turn, Failure::kNone, ""};
  double speed = regulated_speed(situation, *carrot);
  if (reverses_to(*carrot)) speed = std::max(-speed, setup_.limits.vx_min);
  return {{speed, 0.0, speed * carrot->curvature}, Failure::kNone, ""};
}

}  // namespace

void PurePursuitParams::validate() const {
  if (min_lookahead_dist > max_lookahead_dist) {
    throw Error("min_lookahead_dist: " + std::to_string(min_lookahead_dist) +
                " m is greater than max_lookahead_dist, " + std::to_string(max_lookahead_dist) +
                " m");
  }
}

void add_pure_pursuit(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& params,
                                 const std::string& label) {
    return std::make_unique<PurePursuitLaw>(setup,
                                            load_config_node<PurePursuitParams>(params, label));
  };
  factory.fields = config_fields<PurePursuitParams>();
  registry.add("regulated_pure_pursuit", factory);
  registry.add("nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController", factory);
}

}  // namespace trident::nav
