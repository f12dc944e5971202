// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/packet_writer.h"

namespace trident::bridges::sitl {

/// What HIL_SENSOR carries. Vectors in the vehicle's frame: forward, right, down.
struct HilSensor {
  /// Parts that are new, as HIL_SENSOR.fields_updated has them.
  enum Fields : std::uint32_t {
    kAccelerometer = 0x7,
    kGyroscope = 0x38,
    kMagnetometer = 0x1C0,
    kBarometer = 0x1A00,  ///< pressure, altitude and temperature
    kDifferentialPressure = 0x400,
    kReset = 0x80000000U  ///< time or state has jumped
  };
  Eigen::Vector3d a_frd = Eigen::Vector3d::Zero();               ///< specific force [m/s^2]
  Eigen::Vector3d w_frd = Eigen::Vector3d::Zero();               ///< [rad/s]
  Eigen::Vector3d magnetic_frd_gauss = Eigen::Vector3d::Zero();  ///< [gauss]
  double pressure_hpa = 0.0;                                     ///< static [hPa]
  double differential_pressure_hpa = 0.0;                        ///< of the airspeed sensor [hPa]
  double pressure_altitude_m = 0.0;                              ///< by the standard atmosphere
  double temperature_c = 0.0;                                    ///< of the barometer
  std::uint32_t fields = 0;                                      ///< of Fields
};

/// What HIL_GPS carries.
struct HilGps {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;  ///< as PX4 takes it
  Eigen::Vector3d v_ned = Eigen::Vector3d::Zero();                   ///< [m/s]
  double horizontal_error_m = 1.0, vertical_error_m = 1.0;           ///< eph, epv
  int satellites = 10;                                               ///< in view
};

/// What HIL_STATE_QUATERNION carries: the true state.
struct HilState {
  Eigen::Quaterniond R_ned_frd = Eigen::Quaterniond::Identity();     ///< of the body
  Eigen::Vector3d w_frd = Eigen::Vector3d::Zero();                   ///< [rad/s]
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;  ///< of the body
  Eigen::Vector3d v_ned = Eigen::Vector3d::Zero();                   ///< [m/s]
  double airspeed_m_s = 0.0;                                         ///< true
  Eigen::Vector3d a_frd = Eigen::Vector3d::Zero();                   ///< specific force [m/s^2]
};

/// What the newest HIL_ACTUATOR_CONTROLS says.
struct HilControls {
  std::array<float, 16> values{};  ///< [-1, 1], as they came
  bool is_armed = false;           ///< MAV_MODE_FLAG_SAFETY_ARMED
  std::uint64_t count = 0;         ///< of these messages so far, to see what is new
};

/// The simulator's end of PX4's simulator API, without a socket or a clock: bytes and times go in,
/// bytes come out. From the first HIL_ACTUATOR_CONTROLS of a connection on there is one answer to
/// each HIL_SENSOR (lockstep). Until then PX4 boots and needs simulated time to do so: it is given
/// sensors at the pace of the wall clock. The very first ones are waited on for kFirstPatience_s: a
/// program that answers them is in lockstep from the beginning, and its run can be repeated.
class Px4Link {
 public:
  /// For the first answer of a connection, wall time [s].
  static constexpr double kFirstPatience_s = 2.0;

  /// Takes packets that are to be sent to PX4.
  using Send = std::function<void(mavlink::Bytes)>;
  /// `lockstep`: wait for answers at all. `free_period_s`: wall time between sensors until the
  /// first answer [s].
  Px4Link(bool lockstep, double free_period_s, Send send)
      : lockstep_(lockstep), free_period_s_(free_period_s), send_(std::move(send)) {}

  void connected();     ///< PX4 has connected; it has answered nothing yet
  void disconnected();  ///< it has gone, and has to connect before the world continues
  void give_up();       ///< not waited for until it connects, or answers, again
  /// Bytes of the stream from PX4, in pieces of any size.
  void received(mavlink::Bytes bytes);

  /// Sends HIL_SENSOR at simulated time `now`; `wall_s` is a wall time that never jumps.
  void send_sensor(SimTime now, const HilSensor& sensor, double wall_s);
  /// Sends HIL_GPS, measured at `stamp`.
  void send_gps(SimTime stamp, const HilGps& gps);
  /// Sends HIL_STATE_QUATERNION.
  void send_state(SimTime now, const HilState& state);

  /// Whether the next step must wait, at wall time `wall_s`: for a connection, or an answer.
  bool is_awaited(double wall_s) const;
  bool is_connected() const { return is_connected_; }    ///< a connection is there
  bool was_connected() const { return was_connected_; }  ///< there was one, now or before
  bool has_answered() const { return has_answered_; }    ///< in this connection: it is in lockstep
  bool runs_free() const;  ///< sensors have been sent that were not waited on
  /// Simulated time of the newest HIL_SENSOR of this connection.
  SimTime asked() const { return asked_.at; }

  const HilControls& controls() const { return controls_; }  ///< of the newest answer
  /// Answers to sensors other than the newest, which count for nothing.
  std::uint64_t stale_answers() const { return stale_answers_; }
  const mavlink::ParserCounts& counts() const { return parser_.counts(); }  ///< of what came

 private:
  /// Time as PX4 sees it: it never returns, whatever a reset or a snapshot does to the world's.
  std::uint64_t growing_us(SimTime now, bool* has_jumped);
  void take_answer(const mavlink::Message& message);
  void write(const mavlink::Message& message) { send_(writer_.write(message)); }

  bool lockstep_;
  double free_period_s_;
  Send send_;
  mavlink::PacketParser parser_;
  mavlink::PacketWriter writer_;
  bool is_connected_ = false, was_connected_ = false, is_given_up_ = false;
  bool has_answered_ = false;
  /// HIL_SENSORs of this connection.
  struct Asked {
    bool is_open = false;     ///< the newest is without its answer
    std::uint64_t count = 0;  ///< of them
    double wall_s = 0.0;      ///< when the newest was sent
    SimTime at;               ///< the same in simulated time
    std::uint64_t first_us = 0, newest_us = 0;
  };
  Asked asked_;
  std::int64_t shift_us_ = 0;    ///< from simulated time to PX4's
  std::uint64_t newest_us_ = 0;  ///< ever sent
  HilControls controls_;
  std::uint64_t stale_answers_ = 0;
};

}  // namespace trident::bridges::sitl
