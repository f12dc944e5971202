// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Characters of six bits, in which AIS messages are carried (ITU-R M.1371-5; IEC 61162-1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "trident_bridges/nmea/fixed.h"

namespace trident::bridges::nmea {

/// Bits of one message, the first one first.
class AisBits {
 public:
  /// Five slots, the longest message (ITU-R M.1371-5, annex 2, 3.2.2.1), and what six divides.
  static constexpr std::size_t kMaxBits = 1'014;

  std::size_t size() const { return size_; }  ///< [bits]
  void clear() { size_ = 0; }                 ///< no bits
  /// Adds the `count` lowest bits of a value. False: there is no room for them.
  bool append(std::uint32_t value, std::size_t count);
  /// Up to 32 bits from `at` on; at + count <= size().
  std::uint32_t get(std::size_t at, std::size_t count) const;
  /// Takes bits off the end; count <= size().
  void drop(std::size_t count) { size_ -= count; }

 private:
  std::array<std::uint8_t, (kMaxBits + 7) / 8> bytes_{};
  std::size_t size_ = 0;
};

/// Adds the bits of the characters of a sentence. False: a character stands for no six bits, or
/// there is no room.
bool append_payload(std::string_view payload, AisBits* bits);
/// The bits from `at` on as up to `max_characters` characters; zeros are added to fill the last
/// one.
FixedText<72> payload_of(const AisBits& bits, std::size_t at, std::size_t max_characters);
/// Bits that were added by payload_of(), 0 to 5.
int fill_bits_of(const AisBits& bits, std::size_t at, std::size_t max_characters);

/// The archive that fills a message's struct from its bits. Bits behind the end are zeros, as some
/// senders leave off what is empty.
class BitReader {
 public:
  /// `bits` outlives the reader.
  explicit BitReader(const AisBits& bits) : bits_(bits) {}

  void whole(std::uint32_t& value, std::size_t count);  ///< an unsigned number
  void flag(bool& value);                               ///< one bit
  void skip(std::size_t count) { at_ += count; }        ///< bits without a meaning here
  /// An unsigned number, of which `scale` are one; nothing for `absent` and beyond `most`.
  void real(std::optional<double>& value, std::size_t count, double scale, std::uint32_t most,
            std::uint32_t absent);
  /// A two's complement number, of which `scale` are one; nothing beyond +-`limit`.
  void signed_real(std::optional<double>& value, std::size_t count, double scale, double limit);
  /// Rate of turn: 4.733 times the root of degrees per minute; nothing when it is not known.
  void turn_rate(std::optional<double>& deg_min);
  /// Characters of six bits, up to "@" or the end, without blanks behind.
  template <std::size_t Capacity>
  void text(FixedText<Capacity>& value) {
    std::array<char, Capacity> characters{};
    value.assign({characters.data(), read_text(characters.data(), Capacity)});
  }

 private:
  std::uint32_t next(std::size_t count);
  std::size_t read_text(char* characters, std::size_t count);

  const AisBits& bits_;
  std::size_t at_ = 0;
};

/// The archive that writes a message's struct as bits; see BitReader.
class BitWriter {
 public:
  /// `bits` outlives the writer.
  explicit BitWriter(AisBits& bits) : bits_(bits) {}

  void whole(std::uint32_t& value, std::size_t count);  ///< an unsigned number
  void flag(bool& value);                               ///< one bit
  void skip(std::size_t count);                         ///< zeros
  /// Limited to 0 ... `most`.
  void real(std::optional<double>& value, std::size_t count, double scale, std::uint32_t most,
            std::uint32_t absent);
  /// Limited to +-`limit`; what is absent becomes `limit` and one more: 91 or 181 degrees.
  void signed_real(std::optional<double>& value, std::size_t count, double scale, double limit);
  void turn_rate(std::optional<double>& deg_min);  ///< limited to 708 degrees per minute
  /// Capitals; characters that six bits cannot hold become blanks.
  template <std::size_t Capacity>
  void text(FixedText<Capacity>& value) {
    write_text(value.view(), Capacity);
  }

 private:
  void write_text(std::string_view text, std::size_t count);

  AisBits& bits_;
};

}  // namespace trident::bridges::nmea
