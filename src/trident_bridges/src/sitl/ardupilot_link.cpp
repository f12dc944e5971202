// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/sitl/ardupilot_link.h"

#include <cstdio>

#include "trident_base/error.h"

namespace trident::bridges::sitl {
namespace {

constexpr std::uint16_t kMagic16 = 18458, kMagic32 = 29569;
constexpr std::size_t kHeaderSize = 8;  ///< [bytes] magic, frame_rate, frame_count

std::uint16_t read_u16(Span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | (bytes[at + 1] << 8));
}

std::size_t channels_of(std::uint16_t magic) {
  if (magic == kMagic16) return 16;
  if (magic == kMagic32) return 32;
  throw Error("servo packet: magic is " + std::to_string(magic) + ", legal: 18458 or 29569");
}

void append(std::string& out, const char* name, const double* values, int count) {
  char text[40];
  out.append("\"").append(name).append("\":[");
  for (int i = 0; i < count; ++i) {
    std::snprintf(text, sizeof(text), i == 0 ? "%.12g" : ",%.12g", values[i]);
    out.append(text);
  }
  out.append("]");
}

}  // namespace

ServoPacket parse_servo_packet(Span<const std::uint8_t> datagram) {
  if (datagram.size() < kHeaderSize) {
    throw Error("servo packet: length is " + std::to_string(datagram.size()) +
                " bytes, legal: 40 or 72");
  }
  ServoPacket packet;
  packet.channels = channels_of(read_u16(datagram, 0));
  const std::size_t legal = kHeaderSize + 2 * packet.channels;
  if (datagram.size() != legal) {
    throw Error("servo packet: length is " + std::to_string(datagram.size()) +
                " bytes, legal with magic " + std::to_string(read_u16(datagram, 0)) + ": " +
                std::to_string(legal));
  }
  packet.frame_rate_hz = read_u16(datagram, 2);
  if (packet.frame_rate_hz == 0) throw Error("servo packet: frame_rate is 0, legal: 1 to 65535");
  packet.frame_count = read_u16(datagram, 4) | (std::uint32_t{read_u16(datagram, 6)} << 16);
  for (std::size_t i = 0; i < packet.channels; ++i) {
    packet.pwm[i] = read_u16(datagram, kHeaderSize + 2 * i);
  }
  return packet;
}

std::string to_json(const JsonState& state, double timestamp_s) {
  char text[64];
  std::string out;
  std::snprintf(text, sizeof(text), "\n{\"timestamp\":%.9f,\"imu\":{", timestamp_s);
  out.append(text);
  append(out, "gyro", state.w_frd.data(), 3);
  out.append(",");
  append(out, "accel_body", state.a_frd.data(), 3);
  out.append("},");
  append(out, "position", state.p_ned.data(), 3);
  out.append(",");
  append(out, "velocity", state.v_ned.data(), 3);
  out.append(",");
  const Eigen::Quaterniond& R = state.R_ned_frd;
  const double quaternion[] = {R.w(), R.x(), R.y(), R.z()};
  append(out, "quaternion", quaternion, 4);
  if (state.airspeed_m_s) {
    std::snprintf(text, sizeof(text), ",\"airspeed\":%.6g", *state.airspeed_m_s);
    out.append(text);
  }
  return out.append("}\n");
}

bool ArduPilotLink::begins_program(const ServoPacket& packet) const {
  return joins_ == 0 || is_gone_ || packet.frame_count < servos_.frame_count;
}

void ArduPilotLink::received(Span<const std::uint8_t> datagram) {
  const ServoPacket packet = parse_servo_packet(datagram);
  const bool is_new_program = begins_program(packet);
  if (!is_new_program && packet.frame_count == servos_.frame_count) {
    ++repeats_;
    // Before its step is made there is nothing to repeat: the answer comes by itself.
    if (!has_packet_) send_answer();
    return;
  }
  if (is_new_program) ++joins_;
  servos_ = packet;
  has_packet_ = true;
  is_given_up_ = is_gone_ = false;
  ++packets_;
}

void ArduPilotLink::send_state(const JsonState& state) {
  if (!has_packet_) return;
  has_packet_ = false;
  answered_ = state.stamp;
  if (state.stamp.ns + shift_ns_ <= newest_ns_) shift_ns_ = newest_ns_ + 1'000'000 - state.stamp.ns;
  newest_ns_ = state.stamp.ns + shift_ns_;
  answer_ = to_json(state, 1e-9 * static_cast<double>(newest_ns_));
  send_answer();
}

void ArduPilotLink::send_answer() {
  if (answer_.empty()) return;
  send_({reinterpret_cast<const std::uint8_t*>(answer_.data()), answer_.size()});
}

void ArduPilotLink::disconnected() {
  is_gone_ = joins_ > 0;
  has_packet_ = false;
}

void ArduPilotLink::give_up() { is_given_up_ = true; }

}  // namespace trident::bridges::sitl
