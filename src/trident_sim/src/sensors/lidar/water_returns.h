// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/plugins/plugin_util.h"
#include "trident_base/random_stream.h"
#include "trident_sim/ray_scene.h"

namespace trident::sim {

class WaterSurface;

/// What a beam gets back from the sea. Water hides what lies beyond it in any case.
enum class WaterReturns {
  kAuto,  ///< as a lidar at 905 nm does: see water_return_probability()
  kOff,   ///< nothing
  kOn     ///< always, as an echo sounder
};

/// The plugin's <water_returns>: auto, off or on. Throws Error for anything else.
WaterReturns read_water_returns(const PluginParams& params, WaterReturns fallback);

/// How likely a lidar notices the light that comes straight back from water at a distance, whose
/// surface leans away from the beam by an angle of this cosine.
///
/// What comes back is compared with what a white board of reflectivity 0.1 gives at 100 m, the
/// range of a VLP-16's kind, where one beam in e is lost:
///   p = 1 - exp(-(rho / 0.1) (100 m / r)^2).
/// The apparent reflectivity rho is that of mirrors no larger than the beam, whose slopes about
/// the tile's are normal with a mean square s^2 = 0.01 (ripples of a light wind; Cox and Munk 1954,
/// Bufton, Hoge and Swift 1983), and of little that is scattered back from below and by foam:
///   rho(theta) = R exp(-tan^2(theta) / s^2) / (4 s^2 cos^5(theta)) + 0.0005 cos(theta),
/// R = 0.02 being Fresnel's reflectivity of water straight on. So a lidar above the sea sees the
/// patch below it, some 15 degrees around, and one on a boat the water within few metres.
double water_return_probability(double cos_incidence, double distance_m);

/// Decides beam by beam whether what it hit is reported, in a scene that sees water.
class WaterSight {
 public:
  /// `sensor_name` names its random numbers.
  WaterSight(WaterReturns returns, std::uint64_t seed, const std::string& sensor_name)
      : returns_(returns), stream_(seed, sensor_name + "/water") {}

  /// What the sensor notices of `behind`, which a beam of unit direction has hit in `scene` without
  /// the water; `scan` and `channel` are those of the beam. Under water, `auto` sees nothing, as
  /// water swallows light of 905 nm within decimetres; `on` and `off` see what is there, as through
  /// clear water.
  RayHit see(const RayScene& scene, const WaterSurface& water, const Ray& ray, const RayHit& behind,
             std::uint64_t scan, std::uint32_t channel) const;

 private:
  bool reports(const WaterSurface& water, std::uint32_t water_shape, const Ray& ray,
               const RayHit& hit, std::uint64_t scan, std::uint32_t channel) const;

  WaterReturns returns_;
  RandomStream stream_;
};

}  // namespace trident::sim
