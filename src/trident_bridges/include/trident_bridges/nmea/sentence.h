// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trident_bridges/nmea/refusal.h"

namespace trident::bridges::nmea {

/// Longest legal sentence with "$" or "!", checksum, CR and LF (NMEA 0183 4.11, 5.3).
inline constexpr std::size_t kMaxSentenceLength = 82;

/// XOR of the characters between "$" or "!" and "*".
std::uint8_t checksum_of(std::string_view body);

/// A type such as "GGA" as a number, for comparisons; 0 when it has not three characters.
constexpr std::uint32_t type_code(std::string_view type) {
  if (type.size() != 3) return 0;
  return static_cast<std::uint32_t>(static_cast<unsigned char>(type[0])) << 16U |
         static_cast<std::uint32_t>(static_cast<unsigned char>(type[1])) << 8U |
         static_cast<std::uint32_t>(static_cast<unsigned char>(type[2]));
}

/// One sentence, taken apart at its commas. A view of characters that somebody else owns.
class Sentence {
 public:
  /// More fields than a sentence of the longest that is accepted can hold.
  static constexpr std::size_t kMaxFields = 64;

  /// Takes `text` apart: from "$" or "!" up to the last character before "*". False, with
  /// `refusal` filled, when it has no talker and type, or too many fields.
  bool assign(std::string_view text, Refusal* refusal);

  std::string_view text() const { return text_; }  ///< from "$" or "!" on, without "*" and checksum
  char start() const { return text_[0]; }          ///< '$', or '!' of encapsulated data (AIS)
  /// Two characters, such as "GP"; "P" of a sentence that a manufacturer has defined.
  std::string_view talker() const { return talker_; }
  std::string_view type() const { return type_; }  ///< "GGA"; of a proprietary one: "SRF103"
  bool is_proprietary() const { return talker_.size() == 1; }  ///< defined by a manufacturer
  std::size_t field_count() const { return field_count_; }     ///< without the address
  /// index < field_count().
  std::string_view field(std::size_t index) const {
    return text_.substr(begins_[index], begins_[index + 1] - 1U - begins_[index]);
  }
  /// NMEA 4.10's "\...\" before the sentence, without the backslashes; empty: it is absent.
  std::string_view tag_block() const { return tag_block_; }
  void set_tag_block(std::string_view tag_block) { tag_block_ = tag_block; }  ///< as a view

 private:
  bool read_address(std::string_view address, Refusal* refusal);

  std::string_view text_, talker_, type_, tag_block_;
  std::array<std::uint16_t, kMaxFields + 1>
      begins_{};  ///< of the fields, and behind the last comma
  std::size_t field_count_ = 0;
};

}  // namespace trident::bridges::nmea
