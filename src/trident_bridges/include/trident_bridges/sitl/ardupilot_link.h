// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "trident_base/sim_time.h"
#include "trident_base/span.h"

namespace trident::bridges::sitl {

/// The newest packet of servo outputs.
struct ServoPacket {
  std::uint16_t frame_rate_hz = 0;      ///< steps of physics that ArduPilot asks for
  std::uint32_t frame_count = 0;        ///< counts its packets; begins again with its program
  std::array<std::uint16_t, 32> pwm{};  ///< [us]; 0: that servo has no output
  std::size_t channels = 0;             ///< 16 or 32 of them count
};

/// What the answer of the simulator carries.
struct JsonState {
  SimTime stamp;                                                  ///< of the state
  Eigen::Vector3d w_frd = Eigen::Vector3d::Zero();                ///< [rad/s]
  Eigen::Vector3d a_frd = Eigen::Vector3d::Zero();                ///< specific force [m/s^2]
  Eigen::Vector3d p_ned = Eigen::Vector3d::Zero();                ///< from the world's origin [m]
  Eigen::Vector3d v_ned = Eigen::Vector3d::Zero();                ///< [m/s]
  Eigen::Quaterniond R_ned_frd = Eigen::Quaterniond::Identity();  ///< of the body
  std::optional<double> airspeed_m_s;                             ///< where there is a sensor
};

/// One line of JSON with a line feed before and behind it, as ArduPilot's SITL reads it (JSON
/// backend); `timestamp_s` replaces the state's stamp.
std::string to_json(const JsonState& state, double timestamp_s);

/// Reads a packet of servo outputs: little-endian, magic 18458 with 16 or 29569 with 32 channels.
/// Throws Error with the field, the value and the legal range.
ServoPacket parse_servo_packet(Span<const std::uint8_t> datagram);

/// The simulator's end of ArduPilot's JSON interface, without a socket or a clock: datagrams go in
/// and come out. Each packet of servo outputs is one step of physics, answered by its state. A
/// packet that comes twice gets the last answer again; a count that begins again is a new program.
class ArduPilotLink {
 public:
  /// Takes the datagrams for ArduPilot.
  using Send = std::function<void(Span<const std::uint8_t>)>;
  /// `lockstep`: wait for packets at all.
  ArduPilotLink(bool lockstep, Send send) : lockstep_(lockstep), send_(std::move(send)) {}

  /// A datagram of ArduPilot. Throws Error for one that is no packet of servo outputs, and ignores
  /// it.
  void received(Span<const std::uint8_t> datagram);
  /// The state after the step that the newest packet was for. Nothing is sent without such a
  /// packet.
  void send_state(const JsonState& state);
  /// The program is not there any more: it has to send a packet before the world continues.
  void disconnected();
  void give_up();  ///< not waited for until its next packet

  /// Whether the next step that ends with a state must wait for a packet.
  bool is_awaited() const { return lockstep_ && !is_given_up_ && !has_packet_; }
  bool has_joined() const { return joins_ > 0; }  ///< a packet has come, now or before
  /// It has joined, and nobody waits for it.
  bool runs_free() const { return !lockstep_ && has_joined(); }
  bool is_gone() const { return is_gone_; }              ///< disconnected() since the last packet
  const ServoPacket& servos() const { return servos_; }  ///< of the newest packet
  std::uint64_t packets() const { return packets_; }     ///< that were no repeats
  std::uint64_t repeats() const { return repeats_; }     ///< packets that came twice
  std::uint64_t joins() const { return joins_; }         ///< programs that began
  SimTime answered() const { return answered_; }         ///< stamp of the last answer

 private:
  bool begins_program(const ServoPacket& packet) const;
  void send_answer();

  bool lockstep_;
  Send send_;
  ServoPacket servos_;
  bool has_packet_ = false, is_given_up_ = false, is_gone_ = false;
  std::uint64_t packets_ = 0, repeats_ = 0, joins_ = 0;
  SimTime answered_{-1};
  std::int64_t shift_ns_ = 0;  ///< from simulated time to ArduPilot's, which never returns
  std::int64_t newest_ns_ = -1;
  std::string answer_;
};

}  // namespace trident::bridges::sitl
