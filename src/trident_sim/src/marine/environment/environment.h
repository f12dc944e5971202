// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "environment_params.h"
#include "trident_sim/sea.h"
#include "wave_field.h"

namespace trident::sim {

/// The sea that an environment describes; its wind is a Wind of its own.
class Environment : public Sea {
 public:
  /// `seabed`: what the environment's bathymetry says; nullptr: there is no ground. Throws Error
  /// for values that are not legal.
  Environment(const EnvironmentParams& params, std::uint64_t seed,
              std::shared_ptr<const Seabed> seabed = nullptr)
      : seabed_(std::move(seabed)),
        waves_(waves_over(params, seabed_.get()), seed, ground_depth(seabed_)),
        current_(params.current, water_depth(params, seabed_)) {
    waves_.set_level(params.water_level, params.tide);
  }

  const Water& water() const override { return waves_; }
  const Current& current() const override { return current_; }
  double depth_m(const Eigen::Vector2d& p_world, double time_s) const override {
    if (seabed_ == nullptr) return std::numeric_limits<double>::infinity();
    return seabed_->depth_m(p_world) + waves_.level_m(time_s);
  }
  double still_level_m(double time_s) const override { return waves_.level_m(time_s); }
  /// Four standard deviations of the surface.
  double significant_height_m() const override {
    double variance = 0.0;
    for (const WaveComponent& wave : waves_.components()) {
      variance += 0.5 * wave.amplitude_m * wave.amplitude_m;
    }
    return 4.0 * std::sqrt(variance);
  }
  const WaveField& waves() const { return waves_; }

 private:
  /// Waves' lengths are those of water as deep as the sea is in the mean, unless a depth is given:
  /// a length that changed from place to place would want phases that add up along the path.
  static WaveParams waves_over(const EnvironmentParams& params, const Seabed* seabed) {
    constexpr double kMinDepth_m = 0.1;
    WaveParams waves = params.waves;
    if (seabed != nullptr && std::isinf(waves.depth)) {
      waves.depth = std::max(kMinDepth_m, seabed->mean_depth_m(params.water_level));
    }
    return waves;
  }
  static DepthFunction ground_depth(const std::shared_ptr<const Seabed>& seabed) {
    if (seabed == nullptr) return {};
    return [seabed](const Eigen::Vector2d& p_world, double enough) {
      return seabed->depth_m(p_world, enough);
    };
  }
  static Current::WaterDepth water_depth(const EnvironmentParams& params,
                                         const std::shared_ptr<const Seabed>& seabed) {
    if (seabed == nullptr) return {};
    return [seabed, level = params.water_level, tide = params.tide](const Eigen::Vector2d& p_world,
                                                                    double time_s) {
      return seabed->depth_m(p_world) + level + tide.level_m(time_s);
    };
  }

  std::shared_ptr<const Seabed> seabed_;
  WaveField waves_;
  Current current_;
};

}  // namespace trident::sim
