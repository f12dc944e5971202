// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tide.h"
#include "water.h"
#include "wave_lanes.h"
#include "wave_spectrum.h"

namespace trident::sim {

/// Depth of the ground below z = 0 at a place [m]; negative on land.
using DepthFunction = std::function<double(const Eigen::Vector2d& p_world, double enough)>;

/// Waves by linear (Airy) theory or Gerstner's, as a function of place, time and seed. Linear:
///   eta = sum a cos(theta), theta = k d . p - omega t + phase,
///   velocity = sum a omega (d cosh(k(z+h)) cos(theta), sinh(k(z+h)) sin(theta)) / sinh(k h),
/// in deep water exp(k z) for both quotients. Gerstner's particles move on the same ellipses about
/// their places of rest, which are found for a given place. The amplitude grows as 1 -
/// exp(-t/tau) and fades (smoothstep) where the ground is nearer than `shore_depth`; with a ground
/// and without a shore_depth where it is nearer than twice the significant height, at which waves
/// begin to break.
class WaveField : public Water {
 public:
  /// Throws Error for values that are not legal.
  WaveField(const WaveParams& params, std::uint64_t seed, DepthFunction ground_depth = {});

  const WaveParams& params() const { return params_; }
  const std::vector<WaveComponent>& components() const { return waves_; }
  /// Still-water level above z = 0 [m] and how it moves.
  void set_level(double level_m, const TideParams& tide = {}) {
    level_m_ = level_m;
    tide_ = tide;
  }
  double level_m(double time_s = 0.0) const { return level_m_ + tide_.level_m(time_s); }

  WaterColumn column(const Eigen::Vector2d& p_world, const std::array<double, 2>& depths_m,
                     double time_s) const override;
  double elevation_m(const Eigen::Vector2d& p_world, double time_s) const;

  // Linear theory at a point in space (not stretched; above the still level as at the level).
  WaterMotion motion(const Eigen::Vector3d& p_world, double time_s) const;
  /// Velocity potential [m^2/s].
  double potential(const Eigen::Vector3d& p_world, double time_s) const;
  /// Pressure beyond the hydrostatic one, per density: sum g a cosh(k(z+h)) / cosh(k h) cos(theta)
  /// [m^2/s^2].
  double dynamic_pressure_per_density(const Eigen::Vector3d& p_world, double time_s) const;

  /// Factor of all amplitudes at a place and time, in [0, 1].
  double strength(const Eigen::Vector2d& p_world, double time_s) const;
  /// The same where no ground is near.
  double open_strength(double time_s) const;
  /// What the ground does to waves at a place: nothing (kOpen), or it leaves none (kDry), with the
  /// still surface anywhere between two heights.
  enum class Shore : std::uint8_t { kFading, kOpen, kDry };
  Shore shore(const Eigen::Vector2d& p_world, double low_m, double high_m) const;
  /// Whether it depends on the place.
  bool fades() const { return ground_depth_ && params_.shore_depth > 0.0; }

 private:
  /// Eight waves; the last block is filled up with waves of no height.
  struct Block {
    WaveLanes amplitude, omega, phase, k, direction_x, direction_y;
    WaveLanes gerstner;  ///< amplitude of a particle's displacement along the wave
    WaveLanes bed;       ///< 1 / (1 - exp(-2 k depth)), 1 in deep water
  };
  struct Decay {
    WaveLanes horizontal, vertical;
  };
  static WaveLanes theta(const Block& block, const Eigen::Vector2d& p, double time_s);
  /// cosh(k(z+h)) / sinh(k h) and sinh(k(z+h)) / sinh(k h) at z = -depth.
  Decay decay(const Block& block, double depth_m) const;
  void make_blocks();
  Eigen::Vector2d place_of_rest(const Eigen::Vector2d& p_world, double time_s,
                                double strength) const;
  void sum_linear(const Eigen::Vector2d& p, const std::array<double, 2>& depths_m, double time_s,
                  WaterColumn* column) const;
  void bend_slope(const Eigen::Vector2d& p_rest, double time_s, double strength,
                  Eigen::Vector2d* slope) const;

  WaveParams params_;
  std::vector<WaveComponent> waves_;
  std::vector<Block> blocks_;
  bool deep_ = true;  ///< for every wave
  DepthFunction ground_depth_;
  double level_m_ = 0.0;
  TideParams tide_;
};

}  // namespace trident::sim
