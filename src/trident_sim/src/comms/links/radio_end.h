// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "comms/mac/radio_params.h"
#include "trident_base/se3.h"

namespace trident::sim {

class Model;
struct Link;

/// Where an antenna sends to.
enum class AntennaPattern {
  kIsotropic,  ///< everywhere alike
  kDipole      ///< a half-wave dipole along z: around, and little along its axis
};

/// A time without a radio.
struct RadioOutage {
  double begin_s = 0.0, end_s = 0.0;  ///< simulated time; begin <= end
};

/// A radio with its antenna, as a model has it.
struct RadioEnd {
  std::string name;  ///< of the robot
  RadioParams params;
  AntennaPattern pattern = AntennaPattern::kIsotropic;
  double gain_dbi = 2.0;  ///< of the antenna, at its best
  const Model* model = nullptr;
  const Link* link = nullptr;  ///< that it sits on
  SE3 T_link_antenna;
  double height_m = 0.3;  ///< that is in it, above the place that the antenna is mounted at
  std::vector<RadioOutage> outages;

  /// Where it is now, with the axis of the antenna as z.
  SE3 T_world_antenna() const;
  /// Towards a direction of unit length, of an antenna in that pose [dBi].
  double gain_towards_dbi(const SE3& T_world_antenna, const Eigen::Vector3d& direction) const;
};

/// How a radio's plugin hands it to the medium: on an output port that is no topic.
struct RadioEndSample {
  std::shared_ptr<const RadioEnd> end;
};

}  // namespace trident::sim
