// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trident_estimation/filter/filter.h"
#include "trident_estimation/fusion/team_measurements.h"
#include "trident_estimation/fusion/team_model.h"

namespace trident::estimation {

inline constexpr double kTick_s = 1.0 / 30.0;               ///< of the truth
inline constexpr std::size_t kUav = 0, kUgv = 1, kUsv = 2;  ///< robots of a TeamScene

/// What a scene is made of.
struct SceneOptions {
  std::uint64_t seed = 0;
  double duration = 60.0;       ///< [s]
  bool is_every_tick = false;   ///< whether each source measures 30 times a second
  double outliers = 0.0;        ///< share of measurements that are 5 m off
  double gnss_gone_from = 1e9;  ///< of the UGV [s]
  /// Whether the UGV's map drifts as wheel odometry does, and the UAV keeps near it.
  bool is_ugv_followed = false;
};

/// A UAV, a UGV and a USV about a coast, that move as their models say, with what their sensors
/// measure: uav/pose, uav/gnss, uav/altitude, ugv/pose (planar), ugv/gnss, usv/pose, usv/gnss,
/// usv/compass, usv/waterline, uav/sees/ugv, uav/radio/usv.
struct TeamScene {
  std::shared_ptr<const TeamModel> model;
  TeamStart start;                        ///< what is believed at time 0
  std::vector<Eigen::VectorXd> truth;     ///< at each tick, from time 0
  std::vector<Measurement> measurements;  ///< by stamp
};

/// The truth is drawn from the belief at the start, from the models' noise and the sensors', so
/// that a filter that is right is consistent. Equal options, equal bits.
TeamScene make_scene(const SceneOptions& options);

/// A filter before all measurements.
Filter first_belief(const TeamScene& scene, FilterKind kind);

/// Time of a tick.
SimTime tick_time(std::size_t tick);

/// Normalized estimation error squared of all degrees of freedom, or of `count` from `first`.
double nees(const Filter& filter, const Eigen::VectorXd& truth, Eigen::Index first = 0,
            Eigen::Index count = -1);

/// How far robot i is from where it is believed to be [m].
double position_error(const Filter& filter, const Eigen::VectorXd& truth, std::size_t robot);

}  // namespace trident::estimation
