// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "trident_base/sim_time.h"
#include "trident_base/utc_clock.h"
#include "trident_bridges/autopilot/autopilot.h"
#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/vehicles.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::bridges::mavlink {

/// What an inertial sensor felt.
struct ImuReading {
  SimTime stamp;                                           ///< when
  Eigen::Vector3d f_body_m_s2 = Eigen::Vector3d::Zero();   ///< specific force, FLU; at rest +g up
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();  ///< FLU
};

/// What a receiver of satellites said.
struct GnssReading {
  SimTime stamp;                   ///< when
  GeoPlace place;                  ///< of its antenna
  bool has_fix = false;            ///< whether there is a place at all
  bool is_rtk_fixed = false;       ///< carrier phases, ambiguities resolved
  bool is_rtk_float = false;       ///< carrier phases, ambiguities open
  double horizontal_stddev_m = 0;  ///< of each of both axes
  double vertical_stddev_m = 0;    ///< see horizontal_stddev_m
  int satellites = 255;            ///< in view; 255: it does not say
};

/// How strongly a vehicle shakes: the root of what is left of an inertial sensor's specific force
/// above 5 Hz, squared and smoothed below 2 Hz, as ArduPilot does it.
class VibrationMeter {
 public:
  /// One more reading, later than the last.
  void add(const ImuReading& reading);
  const Eigen::Vector3d& level_m_s2() const { return level_m_s2_; }  ///< FLU

 private:
  std::optional<SimTime> last_;
  Eigen::Vector3d floor_m_s2_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d square_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d level_m_s2_ = Eigen::Vector3d::Zero();
};

/// What sensors say besides the state that the autopilot uses; NaN or nothing: nobody says it.
struct VehicleReadings {
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();       ///< FLU
  double voltage_V = std::numeric_limits<double>::quiet_NaN();  ///< of the battery
  double current_A = std::numeric_limits<double>::quiet_NaN();  ///< out of the battery
  std::optional<ImuReading> imu;                                ///< the newest
  std::optional<GnssReading> gnss;                              ///< the newest
  std::optional<Eigen::Vector3d> wind_world_m_s;                ///< where the air goes to
  Eigen::Vector3d vibration_m_s2 = Eigen::Vector3d::Zero();     ///< see VibrationMeter
};

/// All that telemetry is made of.
struct TelemetrySource {
  Address self;                     ///< of the vehicle
  VehicleKind kind;                 ///< decides MAV_TYPE
  AutopilotFlavour flavour;         ///< decides MAV_AUTOPILOT
  const Autopilot& autopilot;       ///< modes, mission, home
  const VehicleState& state;        ///< the newest
  const VehicleReadings& readings;  ///< the newest
  const GeoFrame& geo;              ///< the world on the earth
  const UtcClock& clock;            ///< of the world
  SimTime now;                      ///< of the state

  /// [ms] since the vehicle was switched on, which is when the world began.
  std::uint32_t boot_ms() const { return static_cast<std::uint32_t>(now.ns / 1'000'000); }
  /// The same in [us].
  std::uint64_t boot_us() const { return static_cast<std::uint64_t>(now.ns / 1000); }
};

/// The message of that id as the vehicle sends it; nullopt: it sends no such message, or cannot
/// now, because it knows no place or home.
std::optional<Message> telemetry_message(std::uint32_t id, const TelemetrySource& source);

}  // namespace trident::bridges::mavlink
