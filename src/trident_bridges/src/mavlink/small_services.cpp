// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/small_services.h"

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

// Of the payload of FILE_TRANSFER_PROTOCOL: https://mavlink.io/en/services/ftp.html.
constexpr std::size_t kSession = 2, kOpcode = 3, kSize = 4, kRequest = 5, kData = 12;

MAV_FTP_ERR error_of(std::uint8_t opcode) {
  switch (opcode) {
    case MAV_FTP_OPCODE_LISTDIRECTORY:
    case MAV_FTP_OPCODE_OPENFILERO:
    case MAV_FTP_OPCODE_REMOVEFILE:
    case MAV_FTP_OPCODE_REMOVEDIRECTORY:
    case MAV_FTP_OPCODE_TRUNCATEFILE:
    case MAV_FTP_OPCODE_RENAME:
    case MAV_FTP_OPCODE_CALCFILECRC:
      return MAV_FTP_ERR_FILENOTFOUND;
    case MAV_FTP_OPCODE_CREATEFILE:
    case MAV_FTP_OPCODE_CREATEDIRECTORY:
    case MAV_FTP_OPCODE_OPENFILEWO:
      return MAV_FTP_ERR_FILEPROTECTED;
    case MAV_FTP_OPCODE_READFILE:
    case MAV_FTP_OPCODE_WRITEFILE:
    case MAV_FTP_OPCODE_BURSTREADFILE:
      return MAV_FTP_ERR_INVALIDSESSION;
    default:
      return MAV_FTP_ERR_UNKNOWNCOMMAND;
  }
}

/// Nothing is open, so there is nothing that could not be closed.
bool succeeds(std::uint8_t opcode) {
  return opcode == MAV_FTP_OPCODE_NONE || opcode == MAV_FTP_OPCODE_TERMINATESESSION ||
         opcode == MAV_FTP_OPCODE_RESETSESSION;
}

}  // namespace

std::optional<Message> file_transfer_answer(const Message& message, Address self) {
  if (!is<mavlink_file_transfer_protocol_t>(message)) return std::nullopt;
  const auto request = unpack<mavlink_file_transfer_protocol_t>(message);
  if (!is_for({request.target_system, request.target_component}, self)) return std::nullopt;
  const std::uint8_t opcode = request.payload[kOpcode];
  if (opcode == MAV_FTP_OPCODE_ACK || opcode == MAV_FTP_OPCODE_NAK) return std::nullopt;
  mavlink_file_transfer_protocol_t answer{};
  answer.target_system = message.source.system;
  answer.target_component = message.source.component;
  const auto sequence =
      static_cast<std::uint16_t>((request.payload[0] | request.payload[1] << 8) + 1);
  answer.payload[0] = static_cast<std::uint8_t>(sequence);
  answer.payload[1] = static_cast<std::uint8_t>(sequence >> 8);
  answer.payload[kSession] = request.payload[kSession];
  answer.payload[kRequest] = opcode;
  if (succeeds(opcode)) {
    answer.payload[kOpcode] = MAV_FTP_OPCODE_ACK;
  } else {
    answer.payload[kOpcode] = MAV_FTP_OPCODE_NAK;
    answer.payload[kSize] = 1;
    answer.payload[kData] = static_cast<std::uint8_t>(error_of(opcode));
  }
  return pack(answer, self);
}

std::optional<Message> log_list_answer(const Message& message, Address self) {
  if (!is<mavlink_log_request_list_t>(message)) return std::nullopt;
  const auto request = unpack<mavlink_log_request_list_t>(message);
  if (!is_for({request.target_system, request.target_component}, self)) return std::nullopt;
  return pack(mavlink_log_entry_t{}, self);
}

Message autopilot_version_message(const VehicleVersion& version, Address self) {
  mavlink_autopilot_version_t payload{};
  payload.capabilities =
      MAV_PROTOCOL_CAPABILITY_MISSION_FLOAT | MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT |
      MAV_PROTOCOL_CAPABILITY_MISSION_INT | MAV_PROTOCOL_CAPABILITY_COMMAND_INT |
      MAV_PROTOCOL_CAPABILITY_SET_ATTITUDE_TARGET |
      MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED |
      MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT | MAV_PROTOCOL_CAPABILITY_MAVLINK2 |
      MAV_PROTOCOL_CAPABILITY_MISSION_FENCE | MAV_PROTOCOL_CAPABILITY_MISSION_RALLY;
  payload.capabilities |= version.is_px4 ? MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
                                         : MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST;
  payload.uid = version.uid;
  payload.flight_sw_version = std::uint32_t{version.major} << 24 |
                              std::uint32_t{version.minor} << 16 |
                              std::uint32_t{version.patch} << 8 | FIRMWARE_VERSION_TYPE_OFFICIAL;
  return pack(payload, self);
}

Message protocol_version_message(bool accept_mavlink1, Address self) {
  mavlink_protocol_version_t payload{};
  payload.version = payload.max_version = 200;
  payload.min_version = accept_mavlink1 ? 100 : 200;
  return pack(payload, self);
}

std::string signing_setup_refusal(const Message& message, bool is_loopback) {
  if (!is<mavlink_setup_signing_t>(message) || is_loopback) return "";
  return "SETUP_SIGNING of system " + std::to_string(message.source.system) +
         " refused: a key is taken from a loopback link alone";
}

}  // namespace trident::bridges::mavlink
