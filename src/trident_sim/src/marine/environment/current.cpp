// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "current.h"

#include <cmath>
#include <utility>

#include "seabed.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

/// Lamb and Oseen's vortex, scaled to turn with `speed` where it turns fastest, at `core_m`.
Eigen::Vector3d lamb_oseen(const Eigen::Vector2d& from_center, double core_m, double speed) {
  constexpr double kPeak = 1.25643120862617;  // root of exp(x) = 1 + 2 x
  const double r2 = from_center.squaredNorm() / (core_m * core_m);
  const double peak = 1.0 - std::exp(-kPeak);
  // (1 - exp(-kPeak r^2)) / r^2 without the division at the centre.
  const double profile = r2 > 1e-8 ? -std::expm1(-kPeak * r2) / r2 : kPeak;
  const double rate = speed / core_m * profile / peak;
  return {-rate * from_center.y(), rate * from_center.x(), 0.0};
}

}  // namespace

void CurrentParams::validate() const {
  if (kind == CurrentKind::kFile && file.empty()) {
    throw Error("current: file = '' must name a file for kind file");
  }
}

Current::Current(const CurrentParams& params, WaterDepth water_depth)
    : params_(params), water_depth_(std::move(water_depth)) {
  params_.validate();
  if (params_.kind == CurrentKind::kFile) {
    grid_ = std::make_shared<const WindGrid>(read_wind_grid(params_.file));
  }
}

Eigen::Vector3d Current::steady(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d along(std::cos(params_.direction), std::sin(params_.direction), 0.0);
  switch (params_.kind) {
    case CurrentKind::kNone:
      break;
    case CurrentKind::kUniform:
      return params_.speed * along;
    // The speed grows to the left of the direction, from its value in the world's origin.
    case CurrentKind::kShear: {
      const double left = along.x() * p_world.y() - along.y() * p_world.x();
      return (params_.speed + params_.shear * left) * along;
    }
    case CurrentKind::kVortex:
      return lamb_oseen(p_world.head<2>() - params_.center, params_.core_radius, params_.speed);
    case CurrentKind::kFile:
      return wind_at(*grid_, p_world).value_or(Eigen::Vector3d::Zero());
  }
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d Current::velocity(const Eigen::Vector3d& p_world, double time_s) const {
  if (params_.kind == CurrentKind::kNone) return Eigen::Vector3d::Zero();
  Eigen::Vector3d flow = steady(p_world);
  if (params_.tide_amplitude != 0.0) {
    const double angle = 2.0 * kPi * time_s / params_.tide_period + params_.tide_phase;
    flow *= 1.0 + params_.tide_amplitude * std::sin(angle);
  }
  if (water_depth_) {
    flow *= shore_fade(water_depth_(p_world.head<2>(), time_s), params_.shore_depth);
  }
  return flow;
}

Eigen::Vector3d Current::rate(const Eigen::Vector3d& p_world, const Eigen::Vector3d& v_world,
                              double time_s) const {
  // The material derivative that a moving hull sees: place and time advance together.
  constexpr double kHalf = 5e-3;  // [s]
  return (velocity(p_world + kHalf * v_world, time_s + kHalf) -
          velocity(p_world - kHalf * v_world, time_s - kHalf)) /
         (2.0 * kHalf);
}

void Current::add_to(const SE3& T_world_co, const Eigen::Vector3d& v_world, double time_s,
                     HullWater* water) const {
  if (params_.kind == CurrentKind::kNone) return;
  const Eigen::Quaterniond R_body_world = T_world_co.R.conjugate();
  water->velocity.head<3>() += R_body_world * velocity(T_world_co.p, time_s);
  // Only a uniform current without tide and shore has no rate, which saves its two evaluations.
  const bool is_uniform =
      params_.kind == CurrentKind::kUniform && params_.tide_amplitude == 0.0 && !water_depth_;
  if (!is_uniform) {
    water->acceleration.head<3>() += R_body_world * rate(T_world_co.p, v_world, time_s);
  }
}

}  // namespace trident::sim
