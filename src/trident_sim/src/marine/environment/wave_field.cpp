// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "wave_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "seabed.h"

namespace trident::sim {
namespace {

constexpr auto kLanes = static_cast<std::size_t>(WaveLanes::SizeAtCompileTime);

/// Sums of one quantity of the water's motion, lane by lane.
struct MotionSums {
  WaveLanes velocity_along_x = WaveLanes::Zero(), velocity_along_y = WaveLanes::Zero(),
            velocity_up = WaveLanes::Zero();
  WaveLanes acceleration_along_x = WaveLanes::Zero(), acceleration_along_y = WaveLanes::Zero(),
            acceleration_up = WaveLanes::Zero();

  WaterMotion motion() const {
    return {{velocity_along_x.sum(), velocity_along_y.sum(), velocity_up.sum()},
            {acceleration_along_x.sum(), acceleration_along_y.sum(), acceleration_up.sum()}};
  }
};

}  // namespace

WaveField::WaveField(const WaveParams& params, std::uint64_t seed, DepthFunction ground_depth)
    : params_(params), waves_(make_waves(params, seed)), ground_depth_(std::move(ground_depth)) {
  make_blocks();
  if (!ground_depth_ || params_.shore_depth > 0.0) return;
  double variance = 0.0;
  for (const WaveComponent& wave : waves_) variance += 0.5 * wave.amplitude_m * wave.amplitude_m;
  // Waves fade from a depth of twice the significant height on, Hs = 4 sqrt(m0).
  params_.shore_depth = 2.0 * 4.0 * std::sqrt(variance);
}

void WaveField::make_blocks() {
  Block none;
  none.amplitude = none.omega = none.phase = none.gerstner = WaveLanes::Zero();
  // Unused lanes have no amplitude, but a wave number that can be divided by.
  none.k = none.direction_x = none.bed = WaveLanes::Ones();
  none.direction_y = WaveLanes::Zero();
  blocks_.assign((waves_.size() + kLanes - 1) / kLanes, none);
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const WaveComponent& wave = waves_[i];
    Block& block = blocks_[i / kLanes];
    const auto lane = static_cast<Eigen::Index>(i % kLanes);
    block.amplitude[lane] = wave.amplitude_m;
    block.omega[lane] = wave.omega_rad_s;
    block.phase[lane] = wave.phase_rad;
    block.k[lane] = wave.k;
    block.direction_x[lane] = wave.direction.x();
    block.direction_y[lane] = wave.direction.y();
    // Crests of all waves together must not cross: sum of gerstner k <= steepness <= 1.
    const double widest = params_.steepness / (wave.k * static_cast<double>(waves_.size()));
    block.gerstner[lane] = std::min(wave.amplitude_m, widest);
    if (wave.k * params_.depth > 20.0) continue;
    deep_ = false;
    // Finite depth, cosh(k (z + d)) / sinh(k d), is written in exponentials that cannot overflow.
    block.bed[lane] = 1.0 / -std::expm1(-2.0 * wave.k * params_.depth);
  }
}

double WaveField::open_strength(double time_s) const {
  constexpr double kGrown = 40.0;  // 1 - exp(-40) is 1 to the last digit
  if (!(params_.ramp_time > 0.0 && time_s < kGrown * params_.ramp_time)) return 1.0;
  return time_s > 0.0 ? 1.0 - std::exp(-time_s / params_.ramp_time) : 0.0;
}

WaveField::Shore WaveField::shore(const Eigen::Vector2d& p_world, double low_m,
                                  double high_m) const {
  if (!fades()) return Shore::kOpen;
  const double full = params_.shore_depth - low_m, depth = ground_depth_(p_world, full);
  if (depth >= full) return Shore::kOpen;
  return depth + high_m <= 0.0 ? Shore::kDry : Shore::kFading;
}

double WaveField::strength(const Eigen::Vector2d& p_world, double time_s) const {
  double result = open_strength(time_s);
  if (ground_depth_ && params_.shore_depth > 0.0) {
    constexpr double kMore_m = 1.0;  // where rounding cannot matter
    const double level = level_m(time_s), enough = params_.shore_depth - level + kMore_m;
    result *= shore_fade(ground_depth_(p_world, enough) + level, params_.shore_depth);
  }
  return result;
}

WaveLanes WaveField::theta(const Block& block, const Eigen::Vector2d& p, double time_s) {
  return block.k * (block.direction_x * p.x() + block.direction_y * p.y()) - block.omega * time_s +
         block.phase;
}

WaveField::Decay WaveField::decay(const Block& block, double depth_m) const {
  const WaveLanes direct = decaying(block.k * depth_m);
  if (deep_) return {direct, direct};
  // The image of the wave in the ground, as far below it as the point lies above.
  const WaveLanes image = decaying(block.k * (2.0 * std::max(0.0, params_.depth - depth_m)));
  return {direct * (1.0 + image) * block.bed, direct * (1.0 - image) * block.bed};
}

/// The horizontal place about which the particle moves that is now at `p_world`: a fixed point
/// that exists once the crests do not cross, which steepness <= 1 sees to.
Eigen::Vector2d WaveField::place_of_rest(const Eigen::Vector2d& p_world, double time_s,
                                         double strength) const {
  constexpr int kMaxSteps = 30;
  Eigen::Vector2d rest = p_world;
  for (int i = 0; i < kMaxSteps; ++i) {
    WaveLanes x = WaveLanes::Zero(), y = WaveLanes::Zero();
    for (const Block& block : blocks_) {
      const WaveLanes displacement = block.gerstner * sine_cosine(theta(block, rest, time_s)).sine;
      x += displacement * block.direction_x;
      y += displacement * block.direction_y;
    }
    const Eigen::Vector2d next = p_world + strength * Eigen::Vector2d(x.sum(), y.sum());
    const bool done = (next - rest).squaredNorm() < 1e-16;
    rest = next;
    if (done) break;
  }
  return rest;
}

void WaveField::sum_linear(const Eigen::Vector2d& p, const std::array<double, 2>& depths_m,
                           double time_s, WaterColumn* column) const {
  WaveLanes elevation = WaveLanes::Zero(), slope_x = WaveLanes::Zero(), slope_y = WaveLanes::Zero();
  std::array<MotionSums, 2> sums;
  for (const Block& block : blocks_) {
    // Airy's linear waves: elevation a cos(theta), orbital
    // velocities a omega times the decay with depth.
    const SineCosine wave = sine_cosine(theta(block, p, time_s));
    const WaveLanes s = block.amplitude * wave.sine, c = block.amplitude * wave.cosine;
    elevation += c;
    slope_x -= block.k * s * block.direction_x;
    slope_y -= block.k * s * block.direction_y;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Decay d = decay(block, depths_m[i]);
      const WaveLanes across = block.omega * d.horizontal, up = block.omega * d.vertical;
      MotionSums& sum = sums[i];
      sum.velocity_along_x += across * c * block.direction_x;
      sum.velocity_along_y += across * c * block.direction_y;
      sum.velocity_up += up * s;
      sum.acceleration_along_x += block.omega * across * s * block.direction_x;
      sum.acceleration_along_y += block.omega * across * s * block.direction_y;
      sum.acceleration_up -= block.omega * up * c;
    }
  }
  column->elevation_m = elevation.sum();
  column->slope = {slope_x.sum(), slope_y.sum()};
  for (std::size_t i = 0; i < sums.size(); ++i) column->motion[i] = sums[i].motion();
}

/// d eta / d p from d eta / d rest: the crests are drawn together by dp / d rest.
void WaveField::bend_slope(const Eigen::Vector2d& p_rest, double time_s, double strength,
                           Eigen::Vector2d* slope) const {
  WaveLanes xx = WaveLanes::Zero(), xy = WaveLanes::Zero(), yy = WaveLanes::Zero();
  for (const Block& block : blocks_) {
    const WaveLanes narrowing =
        block.gerstner * block.k * sine_cosine(theta(block, p_rest, time_s)).cosine;
    xx += narrowing * block.direction_x * block.direction_x;
    xy += narrowing * block.direction_x * block.direction_y;
    yy += narrowing * block.direction_y * block.direction_y;
  }
  Eigen::Matrix2d J;  // symmetric
  J << 1.0 - strength * xx.sum(), -strength * xy.sum(), -strength * xy.sum(),
      1.0 - strength * yy.sum();
  *slope = J.inverse() * *slope;
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
  result.elevation_m += level_m(time_s);
  return result;
}

double WaveField::elevation_m(const Eigen::Vector2d& p_world, double time_s) const {
  const double factor = waves_.empty() ? 0.0 : strength(p_world, time_s);
  if (factor <= 0.0) return level_m(time_s);
  const bool gerstner = params_.model == WaveModel::kGerstner;
  const Eigen::Vector2d p = gerstner ? place_of_rest(p_world, time_s, factor) : p_world;
  WaveLanes sum = WaveLanes::Zero();
  for (const Block& block : blocks_) {
    sum += block.amplitude * sine_cosine(theta(block, p, time_s)).cosine;
  }
  return level_m(time_s) + factor * sum.sum();
}

WaterMotion WaveField::motion(const Eigen::Vector3d& p_world, double time_s) const {
  WaterColumn sum;
  const double depth = std::max(0.0, level_m(time_s) - p_world.z());
  sum_linear(p_world.head<2>(), {depth, depth}, time_s, &sum);
  const double factor = strength(p_world.head<2>(), time_s);
  return {factor * sum.motion[0].velocity, factor * sum.motion[0].acceleration};
}

double WaveField::potential(const Eigen::Vector3d& p_world, double time_s) const {
  const double depth = std::max(0.0, level_m(time_s) - p_world.z());
  WaveLanes sum = WaveLanes::Zero();
  for (const Block& block : blocks_) {
    sum += block.amplitude * block.omega / block.k * decay(block, depth).horizontal *
           sine_cosine(theta(block, p_world.head<2>(), time_s)).sine;
  }
  return strength(p_world.head<2>(), time_s) * sum.sum();
}

double WaveField::dynamic_pressure_per_density(const Eigen::Vector3d& p_world,
                                               double time_s) const {
  // -d potential / dt, which at the surface is g eta.
  const double depth = std::max(0.0, level_m(time_s) - p_world.z());
  WaveLanes sum = WaveLanes::Zero();
  for (const Block& block : blocks_) {
    sum += block.amplitude * block.omega * block.omega / block.k * decay(block, depth).horizontal *
           sine_cosine(theta(block, p_world.head<2>(), time_s)).cosine;
  }
  return strength(p_world.head<2>(), time_s) * sum.sum();
}

}  // namespace trident::sim
