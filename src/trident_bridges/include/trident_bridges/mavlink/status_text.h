// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// MAV_SEVERITY.
enum class Severity : std::uint8_t {
  kEmergency = 0,
  kAlert = 1,
  kCritical = 2,
  kError = 3,
  kWarning = 4,
  kNotice = 5,
  kInfo = 6,
  kDebug = 7
};

/// A text of a vehicle.
struct StatusText {
  Address source;                       ///< who says it
  Severity severity = Severity::kInfo;  ///< how bad it is
  std::string text;                     ///< whole
};

/// Makes STATUSTEXT of texts: one of up to 50 bytes, or several that belong together.
class StatusTextWriter {
 public:
  explicit StatusTextWriter(Address self) : self_(self) {}
  /// In the order in which they are to be sent. What is beyond 12,750 bytes is cut.
  std::vector<Message> write(Severity severity, const std::string& text);

 private:
  Address self_;
  std::uint16_t id_ = 0;  // of the last text in several parts
};

/// Puts texts together that came in several parts, in any order.
class StatusTextReader {
 public:
  static constexpr double kPatience_s = 2.0;  ///< for parts that are lost: "..." stands for them

  /// The text that a STATUSTEXT completes, if it does.
  std::optional<StatusText> handle(const Message& message, SimTime now);
  /// Texts that will not become whole any more.
  std::vector<StatusText> update(SimTime now);

 private:
  struct Part {
    Severity severity = Severity::kInfo;
    std::map<std::uint8_t, std::string> chunks;
    std::optional<std::uint8_t> last;  // number of the last chunk
    SimTime begun;
  };
  using Key = std::pair<Address, std::uint16_t>;  // sender, id of the text

  Part& part_of(const Key& key, SimTime now);

  std::map<Key, Part> parts_;
};

}  // namespace trident::bridges::mavlink
