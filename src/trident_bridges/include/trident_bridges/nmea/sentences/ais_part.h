// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences that carry AIS messages (ITU-R M.1371).
#pragma once

#include <optional>

#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/sentences/position.h"

namespace trident::bridges::nmea {

/// A message, or a part of one, as characters of six bits.
struct AisPart {
  std::optional<int> total, number;  ///< of sentences; of this one, from 1 on
  std::optional<int> sequence;       ///< of messages in several sentences
  char channel = '\0';               ///< VHF channel A or B; '\0': it was not sent
  FixedText<72> payload;             ///< six bits a character
  std::optional<int> fill_bits;      ///< at the end that are not of the message

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.whole("number of sentences", total, {1, 9});
    ar.whole("sentence", number, {1, 9});
    ar.whole("sequence", sequence, {0, 9});
    ar.letter("channel", channel, "AB12");
    ar.text("payload", payload);
    ar.whole("fill bits", fill_bits, {0, 5});
  }
  /// It has a number within its total, and a payload.
  bool check(Refusal* refusal) const;
};

/// Of another vessel.
struct Vdm : AisPart {
  static constexpr const char* kType = "VDM";  ///< as in "!AIVDM"
};

/// Of the own vessel.
struct Vdo : AisPart {
  static constexpr const char* kType = "VDO";  ///< as in "!AIVDO"
};

}  // namespace trident::bridges::nmea
