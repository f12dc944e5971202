// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "comms/links/obstacles.h"
#include "comms/links/radio_end.h"
#include "comms/phy/propagation.h"
#include "comms/phy/shadowing.h"
#include "trident_sim/sea.h"

namespace trident::sim {

/// How the loss grows with the distance.
enum class PathModel {
  kFreeSpace,    ///< Friis
  kLogDistance,  ///< with an exponent of its own
  kTwoRay        ///< free space, and over water its reflection
};

/// How a world's air carries radio waves.
struct PathLossParams {
  PathModel model = PathModel::kTwoRay;
  double exponent = 2.2;  ///< of kLogDistance
  ShadowingParams shadowing;
  ObstacleParams obstacles;
  Polarization polarization = Polarization::kVertical;
  WaterMirror water;  ///< its significant height is that of the world's sea
};

/// The loss between two antennas in a world, without their gains: the model's over the distance,
/// and by what is in the path; shadowing is ShadowField's. Continuous in both places.
class PathLoss {
 public:
  /// `world` must outlive it.
  PathLoss(World& world, const PathLossParams& params)
      : params_(params), obstacles_(world, params.obstacles) {}

  /// By the distance, at a time, over the world's sea (nullptr: it has none) [dB].
  double over_distance_db(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double wavelength_m,
                          const Sea* sea, double time_s) const;
  /// By what is in the path [dB].
  Obstacles& obstacles() { return obstacles_; }

 private:
  double over_water_db(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double wavelength_m,
                       const Sea& sea, double time_s) const;

  PathLossParams params_;
  Obstacles obstacles_;
};

/// Middle of a channel of the 5 GHz band [Hz].
double channel_frequency_hz(int channel);

}  // namespace trident::sim
