// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "beam_caster.h"
#include "lidar_spec.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {

/// All beams of a sensor's `<scan>`, cast at once from where it is, as gazebo_ros' ray sensors do.
class RayBundle {
 public:
  /// Throws Error as read_lidar_spec() does, and for a plugin outside of a ray sensor.
  /// `water`: what it gets back from the sea unless the plugin has <water_returns>.
  explicit RayBundle(const PluginContext& context, WaterReturns water = WaterReturns::kAuto);

  const LidarSpec& spec() const { return spec_; }
  /// The sensor's rate and the plugin's `<updateRate>`, whichever is lower; 0 does not count.
  const SampleClock& clock() const { return clock_; }
  std::size_t size() const { return directions_.size(); }
  /// Ring by ring, of unit length, in the sensor's frame.
  const Eigen::Vector3d& direction(std::size_t beam) const { return directions_[beam]; }

  /// `scan` is its number since the last reset.
  void cast(std::uint64_t scan);
  /// Infinite: nothing hit in range [m].
  double range_m(std::size_t beam) const { return hit(beam).distance_m; }
  double intensity(std::size_t beam) const { return caster_.intensity(hit(beam)); }

 private:
  RayHit hit(std::size_t beam) const {
    return caster_.hit(beam, scan_, static_cast<std::uint32_t>(beam));
  }

  const Link& link_;
  SE3 T_link_sensor_;
  LidarSpec spec_;
  SampleClock clock_;
  std::vector<Eigen::Vector3d> directions_;
  BeamCaster caster_;
  std::uint64_t scan_ = 0;
};

/// The topic that `<topicName>` names. Throws Error where it is given but empty.
std::string sensor_topic(const PluginParams& params, const std::string& fallback);

}  // namespace trident::sim
