// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "trident_bridges/nmea/ais/six_bit.h"

namespace trident::bridges::nmea {
namespace {

constexpr std::size_t kCharacterBits = 6;
constexpr std::size_t kTurnRateBits = 8;
constexpr double kTurnRateFactor = 4.733;  ///< ITU-R M.1371-5, table 48
constexpr int kMaxTurnRate = 126;        ///< 127: more than 5 degrees in 30 s, by how much is open
constexpr double kDegreesUnknown = 1.0;  ///< by which "not available" is beyond the limit

/// Six bits of a character of a sentence, -1: no such one (IEC 61162-1, 7.2).
int bits_of(char c) {
  if (c >= '0' && c <= 'W') return c - '0';
  return c >= '`' && c <= 'w' ? c - '`' + 40 : -1;
}

char payload_character(std::uint32_t bits) {
  return static_cast<char>(bits < 40 ? bits + '0' : bits - 40 + '`');
}

/// A character of a text (ITU-R M.1371-5, table 47).
char text_character(std::uint32_t bits) { return static_cast<char>(bits < 32 ? bits + '@' : bits); }

std::uint32_t text_bits(char c) {
  if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  if (c >= '@' && c <= '_') return static_cast<std::uint32_t>(c - '@');
  return c >= ' ' && c <= '?' ? static_cast<std::uint32_t>(c) : ' ';
}

std::int32_t sign_extended(std::uint32_t bits, std::size_t count) {
  const std::uint32_t sign = 1U << (count - 1);
  return static_cast<std::int32_t>(bits ^ sign) - static_cast<std::int32_t>(sign);
}

}  // namespace

bool AisBits::append(std::uint32_t value, std::size_t count) {
  if (size_ + count > kMaxBits) return false;
  for (std::size_t i = count; i-- > 0; ++size_) {
    const auto mask = static_cast<std::uint8_t>(0x80U >> size_ % 8);
    std::uint8_t& byte = bytes_[size_ / 8];
    byte = static_cast<std::uint8_t>((value >> i & 1U) != 0 ? byte | mask : byte & ~mask);
  }
  return true;
}

std::uint32_t AisBits::get(std::size_t at, std::size_t count) const {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + count; ++i) {
    value = value << 1U | (bytes_[i / 8] >> (7 - i % 8) & 1U);
  }
  return value;
}

bool append_payload(std::string_view payload, AisBits* bits) {
  for (const char c : payload) {
    const int value = bits_of(c);
    if (value < 0 || !bits->append(static_cast<std::uint32_t>(value), kCharacterBits)) return false;
  }
  return true;
}

FixedText<72> payload_of(const AisBits& bits, std::size_t at, std::size_t max_characters) {
  std::array<char, 72> characters{};
  std::size_t size = 0;
  for (; at < bits.size() && size < std::min(max_characters, characters.size()); ++size) {
    const std::size_t count = std::min(kCharacterBits, bits.size() - at);
    characters[size] = payload_character(bits.get(at, count) << (kCharacterBits - count));
    at += count;
  }
  return FixedText<72>({characters.data(), size});
}

int fill_bits_of(const AisBits& bits, std::size_t at, std::size_t max_characters) {
  const std::size_t left = bits.size() - at;
  if (left > max_characters * kCharacterBits) return 0;
  return static_cast<int>((kCharacterBits - left % kCharacterBits) % kCharacterBits);
}

std::uint32_t BitReader::next(std::size_t count) {
  const std::size_t there = at_ < bits_.size() ? std::min(count, bits_.size() - at_) : 0;
  const std::uint32_t value = there == 0 ? 0 : bits_.get(at_, there) << (count - there);
  at_ += count;
  return value;
}

void BitReader::whole(std::uint32_t& value, std::size_t count) { value = next(count); }

void BitReader::flag(bool& value) { value = next(1) != 0; }

void BitReader::real(std::optional<double>& value, std::size_t count, double scale,
                     std::uint32_t most, std::uint32_t absent) {
  const std::uint32_t units = next(count);
  value.reset();
  if (units != absent && units <= most) value = units / scale;
}

void BitReader::signed_real(std::optional<double>& value, std::size_t count, double scale,
                            double limit) {
  const double number = sign_extended(next(count), count) / scale;
  value.reset();
  if (std::abs(number) <= limit) value = number;
}

void BitReader::turn_rate(std::optional<double>& deg_min) {
  const std::int32_t units = sign_extended(next(kTurnRateBits), kTurnRateBits);
  deg_min.reset();
  if (std::abs(units) > kMaxTurnRate) return;
  const double root = units / kTurnRateFactor;
  deg_min = std::copysign(root * root, root);
}

std::size_t BitReader::read_text(char* characters, std::size_t count) {
  std::size_t size = 0;
  bool has_ended = false;
  for (std::size_t i = 0; i < count; ++i) {
    const char c = text_character(next(kCharacterBits));
    has_ended = has_ended || c == '@';
    if (!has_ended) characters[size++] = c;
  }
  while (size > 0 && characters[size - 1] == ' ') --size;
  return size;
}

void BitWriter::whole(std::uint32_t& value, std::size_t count) { bits_.append(value, count); }

void BitWriter::flag(bool& value) { bits_.append(value ? 1 : 0, 1); }

void BitWriter::skip(std::size_t count) { bits_.append(0, count); }

void BitWriter::real(std::optional<double>& value, std::size_t count, double scale,
                     std::uint32_t most, std::uint32_t absent) {
  if (!value) {
    bits_.append(absent, count);
    return;
  }
  const double units = std::clamp<double>(std::round(*value * scale), 0.0, most);
  bits_.append(static_cast<std::uint32_t>(units), count);
}

void BitWriter::signed_real(std::optional<double>& value, std::size_t count, double scale,
                            double limit) {
  const double number = value ? std::clamp(*value, -limit, limit) : limit + kDegreesUnknown;
  bits_.append(static_cast<std::uint32_t>(std::lround(number * scale)), count);
}

void BitWriter::turn_rate(std::optional<double>& deg_min) {
  constexpr std::int32_t kUnknown = -128;
  std::int32_t units = kUnknown;
  if (deg_min) {
    const double root = std::copysign(std::sqrt(std::abs(*deg_min)), *deg_min);
    const double rounded = std::round(root * kTurnRateFactor);
    units = static_cast<std::int32_t>(std::clamp<double>(rounded, -kMaxTurnRate, kMaxTurnRate));
  }
  bits_.append(static_cast<std::uint32_t>(units), kTurnRateBits);
}

void BitWriter::write_text(std::string_view text, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    bits_.append(i < text.size() ? text_bits(text[i]) : text_bits('@'), kCharacterBits);
  }
}

}  // namespace trident::bridges::nmea
