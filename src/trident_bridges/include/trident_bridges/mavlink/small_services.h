// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// What clients ask of every vehicle and a simulated one answers in one message.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// The answer to FILE_TRANSFER_PROTOCOL: there are no files. Clients that ask for the file of
/// parameters first then ask in the old form at once. nullopt: not for `self`, or no request.
std::optional<Message> file_transfer_answer(const Message& message, Address self);

/// The answer to LOG_REQUEST_LIST: one LOG_ENTRY that says that there are no logs. nullopt: another
/// message.
std::optional<Message> log_list_answer(const Message& message, Address self);

/// What AUTOPILOT_VERSION says.
struct VehicleVersion {
  bool is_px4 = true;      ///< whole numbers of parameters as PX4 encodes them
  std::uint8_t major = 0;  ///< of the firmware that is imitated
  std::uint8_t minor = 0;  ///< see major
  std::uint8_t patch = 0;  ///< see major
  std::uint64_t uid = 0;   ///< of the vehicle
};

/// AUTOPILOT_VERSION. Its capabilities are what this package speaks.
Message autopilot_version_message(const VehicleVersion& version, Address self);
/// PROTOCOL_VERSION: MAVLink 2, and 1 where it is accepted.
Message protocol_version_message(bool accept_mavlink1, Address self);

/// A refusal to take a signing key from a link: SETUP_SIGNING holds the key in the open, and is
/// taken from a loopback link alone. Empty: it may be taken, or the message is another one.
std::string signing_setup_refusal(const Message& message, bool is_loopback);

}  // namespace trident::bridges::mavlink
