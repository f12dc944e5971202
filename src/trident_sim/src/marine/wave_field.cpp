// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "wave_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace trident {
namespace {

double theta(const WaveComponent& wave, const Eigen::Vector2d& p, double time_s) {
  return wave.k * wave.direction.dot(p) - wave.omega_rad_s * time_s + wave.phase_rad;
}

}  // namespace

WaveField::WaveField(const WaveParams& params, std::uint64_t seed, DepthFunction ground_depth)
    : params_(params), waves_(make_waves(params, seed)), ground_depth_(std::move(ground_depth)) {}

double WaveField::strength(const Eigen::Vector2d& p_world, double time_s) const {
  double result = 1.0;
  if (params_.ramp_time > 0.0) {
    result = time_s > 0.0 ? 1.0 - std::exp(-time_s / params_.ramp_time) : 0.0;
  }
  if (ground_depth_ && params_.shore_depth > 0.0) {
    const double part =
        std::clamp((ground_depth_(p_world) + level_m_) / params_.shore_depth, 0.0, 1.0);
    result *= part * part * (3.0 - 2.0 * part);
  }
  return result;
}

WaveField::Decay WaveField::decay(const WaveComponent& wave, double depth_m) const {
  const double direct = std::exp(-wave.k * depth_m);
  if (wave.k * params_.depth > 20.0) return {direct, direct};
  // The image of the wave in the ground, at the distance h - depth below it.
  const double image = std::exp(-2.0 * wave.k * std::max(0.0, params_.depth - depth_m));
  const double bed = 1.0 - std::exp(-2.0 * wave.k * params_.depth);
  return {direct * (1.0 + image) / bed, direct * (1.0 - image) / bed};
}

double WaveField::steepness_of(const WaveComponent& wave) const {
  const double ka = wave.amplitude_m * wave.k;
  if (ka <= 0.0) return 0.0;
  return std::min(1.0, params_.steepness / (ka * static_cast<double>(waves_.size())));
}

/// The horizontal place about which the particle moves that is now at `p_world`: a fixed point
/// that exists once the crests do not cross, which steepness <= 1 sees to.
Eigen::Vector2d WaveField::place_of_rest(const Eigen::Vector2d& p_world, double time_s,
                                         double strength) const {
  constexpr int kMaxSteps = 30;
  Eigen::Vector2d rest = p_world;
  for (int i = 0; i < kMaxSteps; ++i) {
    Eigen::Vector2d next = p_world;
    for (const WaveComponent& wave : waves_) {
      next += strength * steepness_of(wave) * wave.amplitude_m *
              std::sin(theta(wave, rest, time_s)) * wave.direction;
    }
    const bool done = (next - rest).squaredNorm() < 1e-16;
    rest = next;
    if (done) break;
  }
  return rest;
}

void WaveField::sum_linear(const Eigen::Vector2d& p, const std::array<double, 2>& depths_m,
                           double time_s, WaterColumn* column) const {
  for (const WaveComponent& wave : waves_) {
    const double angle = theta(wave, p, time_s);
    const double s = wave.amplitude_m * std::sin(angle), c = wave.amplitude_m * std::cos(angle);
    const double omega = wave.omega_rad_s;
    column->elevation_m += c;
    column->slope -= wave.k * s * wave.direction;
    for (std::size_t i = 0; i < depths_m.size(); ++i) {
      const Decay d = decay(wave, depths_m[i]);
      WaterMotion& motion = column->motion[i];
      motion.velocity.head<2>() += omega * d.horizontal * c * wave.direction;
      motion.velocity.z() += omega * d.vertical * s;
      motion.acceleration.head<2>() += omega * omega * d.horizontal * s * wave.direction;
      motion.acceleration.z() -= omega * omega * d.vertical * c;
    }
  }
}

/// d eta / d p from d eta / d rest: the crests are drawn together by dp / d rest.
void WaveField::bend_slope(const Eigen::Vector2d& p_rest, double time_s, double strength,
                           Eigen::Vector2d* slope) const {
  Eigen::Matrix2d J = Eigen::Matrix2d::Identity();
  for (const WaveComponent& wave : waves_) {
    J -= strength * steepness_of(wave) * wave.amplitude_m * wave.k *
         std::cos(theta(wave, p_rest, time_s)) * wave.direction * wave.direction.transpose();
  }
  *slope = J.transpose().inverse() * *slope;
}

WaterColumn WaveField::column(const Eigen::Vector2d& p_world, const std::array<double, 2>& depths_m,
                              double time_s) const {
  WaterColumn result;
  const double factor = waves_.empty() ? 0.0 : strength(p_world, time_s);
  if (factor > 0.0) {
    const bool gerstner = params_.model == WaveModel::kGerstner;
    const Eigen::Vector2d p = gerstner ? place_of_rest(p_world, time_s, factor) : p_world;
    sum_linear(p, depths_m, time_s, &result);
    result.elevation_m *= factor;
    result.slope *= factor;
    for (WaterMotion& motion : result.motion) {
      motion.velocity *= factor;
      motion.acceleration *= factor;
    }
    if (gerstner) bend_slope(p, time_s, factor, &result.slope);
  }
  result.elevation_m += level_m_;
  return result;
}

double WaveField::elevation_m(const Eigen::Vector2d& p_world, double time_s) const {
  const double factor = waves_.empty() ? 0.0 : strength(p_world, time_s);
  if (factor <= 0.0) return level_m_;
  const bool gerstner = params_.model == WaveModel::kGerstner;
  const Eigen::Vector2d p = gerstner ? place_of_rest(p_world, time_s, factor) : p_world;
  double sum = 0.0;
  for (const WaveComponent& wave : waves_) {
    sum += wave.amplitude_m * std::cos(theta(wave, p, time_s));
  }
  return level_m_ + factor * sum;
}

WaterMotion WaveField::motion(const Eigen::Vector3d& p_world, double time_s) const {
  WaterColumn sum;
  const double depth = std::max(0.0, level_m_ - p_world.z());
  sum_linear(p_world.head<2>(), {depth, depth}, time_s, &sum);
  const double factor = strength(p_world.head<2>(), time_s);
  return {factor * sum.motion[0].velocity, factor * sum.motion[0].acceleration};
}

double WaveField::potential(const Eigen::Vector3d& p_world, double time_s) const {
  const double depth = std::max(0.0, level_m_ - p_world.z());
  double sum = 0.0;
  for (const WaveComponent& wave : waves_) {
    sum += wave.amplitude_m * wave.omega_rad_s / wave.k * decay(wave, depth).horizontal *
           std::sin(theta(wave, p_world.head<2>(), time_s));
  }
  return strength(p_world.head<2>(), time_s) * sum;
}

double WaveField::dynamic_pressure_per_density(const Eigen::Vector3d& p_world,
                                               double time_s) const {
  // -d potential / dt, which at the surface is g eta.
  const double depth = std::max(0.0, level_m_ - p_world.z());
  double sum = 0.0;
  for (const WaveComponent& wave : waves_) {
    sum += wave.amplitude_m * wave.omega_rad_s * wave.omega_rad_s / wave.k *
           decay(wave, depth).horizontal * std::cos(theta(wave, p_world.head<2>(), time_s));
  }
  return strength(p_world.head<2>(), time_s) * sum;
}

}  // namespace trident
