// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// MAV_RESULT.
enum class CommandResult : std::uint8_t {
  kAccepted = 0,
  kTemporarilyRejected = 1,
  kDenied = 2,
  kUnsupported = 3,
  kFailed = 4,
  kInProgress = 5,
  kCancelled = 6
};

/// "accepted", "denied" ...
const char* text_of(CommandResult result);

/// COMMAND_LONG or COMMAND_INT.
struct Command {
  std::uint16_t command = 0;  ///< MAV_CMD
  Address source;             ///< who asks
  bool is_int = false;        ///< COMMAND_INT
  std::uint8_t frame = 0;     ///< MAV_FRAME of a COMMAND_INT
  /// param1 to param7; NaN: not given. Where the command has a place, params[4] and params[5] are
  /// degrees in global frames and in a COMMAND_LONG, and meters in local ones.
  std::array<double, 7> params{};
};

/// How a vehicle answers.
struct CommandReply {
  CommandResult result = CommandResult::kAccepted;  ///< for COMMAND_ACK
  std::string reason;         ///< of a refusal: rule, value, limit; for STATUSTEXT
  std::uint8_t progress = 0;  ///< [%] of kInProgress; 255: not known
};

}  // namespace trident::bridges::mavlink
