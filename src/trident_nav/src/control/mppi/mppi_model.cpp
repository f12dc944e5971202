// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mppi_model.h"

#include <algorithm>
#include <cmath>

#include "lanes.h"
#include "trident_base/angle.h"

namespace trident::nav {
namespace {

// The horizon lets the robot pass as many of its circumscribed radii after braking.
constexpr double kRadiiAhead = 8.0;
// Nav2's horizon at its default speed [m].
constexpr double kTunedLength = 1.4;

double horizon_s(const MotionLimits& limits, const Footprint& footprint) {
  const double braking_s = limits.vx_max / limits.decel_max;
  const double passing_s = kRadiiAhead * footprint.circumscribed_radius / limits.vx_max;
  const double turning_s = limits.min_turning_radius > 0.0
                               ? 0.0
                               : kPi / limits.wz_max + limits.wz_max / limits.alpha_max;
  return braking_s + std::max(passing_s, turning_s);
}

MotionLimits merged(const MppiParams& params, const MotionLimits& robot) {
  MotionLimits limits = robot;
  limits.vx_max = std::min(robot.vx_max, params.vx_max.value_or(robot.vx_max));
  limits.vx_min = std::max(robot.vx_min, params.vx_min.value_or(robot.vx_min));
  limits.vy_max = std::min(robot.vy_max, params.vy_max.value_or(robot.vy_max));
  limits.wz_max = std::min(robot.wz_max, params.wz_max.value_or(robot.wz_max));
  limits.ax_max = std::min(robot.ax_max, params.ax_max.value_or(robot.ax_max));
  limits.decel_max = std::min(robot.decel_max, -params.ax_min.value_or(-robot.decel_max));
  limits.ay_max = std::min(robot.ay_max, params.ay_max.value_or(robot.ay_max));
  limits.alpha_max = std::min(robot.alpha_max, params.az_max.value_or(robot.alpha_max));
  limits.min_turning_radius =
      std::max(robot.min_turning_radius,
               params.AckermannConstraints.min_turning_r.value_or(robot.min_turning_radius));
  return limits;
}

MppiMotion motion_of(const MotionLimits& limits) {
  if (limits.vy_max > 0.0) return MppiMotion::kOmni;
  return limits.min_turning_radius > 0.0 ? MppiMotion::kAckermann : MppiMotion::kDiffDrive;
}

// A quarter of the range of speeds, but no more than a quarter of the horizon changes it by.
double noise_std(double range, double acceleration, double horizon_s) {
  return 0.25 * std::min(range, acceleration * horizon_s);
}

}  // namespace

std::vector<CoverCircle> cover_footprint(const Footprint& footprint) {
  if (footprint.points.empty()) {
    return {{0.0F, 0.0F, static_cast<float>(footprint.circumscribed_radius)}};
  }
  Point2 lo = footprint.points.front();
  Point2 hi = lo;
  for (const Point2& p : footprint.points) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  const bool is_long = hi.x - lo.x >= hi.y - lo.y;
  const double length = std::max(hi.x - lo.x, hi.y - lo.y);
  const double width = std::min(hi.x - lo.x, hi.y - lo.y);
  const Point2 middle{0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y)};
  const int count = std::clamp(static_cast<int>(std::ceil(2.0 * length / width - 1e-9)), 1, 6);
  std::vector<CoverCircle> cover;
  for (int i = 0; i < count; ++i) {
    const double along = (i + 0.5) * length / count;
    const Point2 center = is_long ? Point2{lo.x + along, middle.y} : Point2{middle.x, lo.y + along};
    const double radius = std::hypot(0.5 * length / count, 0.5 * width);
    cover.push_back(
        {static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(radius)});
  }
  return cover;
}

MppiModel make_mppi_model(const MppiParams& params, const ControlSetup& setup) {
  MppiModel model;
  model.limits = merged(params, setup.limits);
  model.motion = params.motion_model.value_or(motion_of(model.limits));
  if (model.motion == MppiMotion::kVessel) {
    model.vessel = load_vessel_motion(params.VesselConstraints);
  }
  model.blocks = 1 + (params.batch_size - 1) / kLanes;
  model.steps = params.time_steps;
  model.dt_s = params.model_dt.value_or(horizon_s(model.limits, setup.footprint) / model.steps);
  model.period_s = setup.period_s;
  const double range = model.limits.vx_max - model.limits.vx_min;
  model.noise_std.vx =
      params.vx_std.value_or(noise_std(range, model.limits.ax_max, model.horizon_s()));
  model.noise_std.vy = params.vy_std.value_or(
      noise_std(2.0 * model.limits.vy_max, model.limits.ay_max, model.horizon_s()));
  model.noise_std.wz = params.wz_std.value_or(
      noise_std(model.limits.wz_max, model.limits.alpha_max, model.horizon_s()));
  model.length_m = model.limits.vx_max * model.horizon_s();
  model.distance_scale = kTunedLength / model.length_m;
  model.inscribed_radius = setup.footprint.inscribed_radius;
  model.circumscribed_radius = setup.footprint.circumscribed_radius;
  model.goal_tolerance_m = setup.tolerance.xy_goal_tolerance;
  model.cover = cover_footprint(setup.footprint);
  return model;
}

}  // namespace trident::nav
