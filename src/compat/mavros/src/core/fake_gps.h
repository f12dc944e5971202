// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Fixes of a receiver that does not exist; for sources alone, as dialect.h is.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/extras_params.h"
#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::mavros {

/// What the receiver would say.
struct FakeFix {
  std::uint64_t time_us = 0;                 ///< of the pose
  std::int64_t unix_ns = 0;                  ///< UTC of the pose, since 1970
  bridges::mavlink::GeoPlace place;          ///< its altitude is above the ellipsoid
  std::optional<Eigen::Vector3d> v_ned_m_s;  ///< nullopt: of the first fix
  double horizontal_accuracy_m = 0.0;        ///< 0: not known
  double vertical_accuracy_m = 0.0;          ///< 0: not known
};

/// Makes fixes from poses in a map whose origin on the earth is known. No clock.
class FakeGps {
 public:
  explicit FakeGps(const FakeGpsParams& params);

  /// The fix at a place of the map (east, north, up) [m]; nullopt: the rate's next one is not due.
  /// A stamp that goes back begins again. `time_us` and place and velocity are filled.
  std::optional<FakeFix> at(SimTime stamp, const Eigen::Vector3d& p_map_m);

 private:
  struct Before {
    SimTime stamp;
    Eigen::Vector3d p_map_m;
  };
  FakeGpsParams params_;
  bridges::mavlink::GeoFrame map_;
  std::optional<Before> before_;
};

/// As HIL_GPS. `geoid_separation_m`: ellipsoid to mean sea level, up.
mavlink_hil_gps_t hil_gps_payload(const FakeFix& fix, const FakeGpsParams& params,
                                  double geoid_separation_m);
/// As GPS_INPUT.
mavlink_gps_input_t gps_input_payload(const FakeFix& fix, const FakeGpsParams& params,
                                      double geoid_separation_m);

}  // namespace trident::mavros
