// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/sentence.h"

#include <algorithm>

namespace trident::bridges::nmea {
namespace {

bool is_address_character(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

}  // namespace

std::uint8_t checksum_of(std::string_view body) {
  std::uint8_t sum = 0;
  for (const char c : body) sum ^= static_cast<std::uint8_t>(c);
  return sum;
}

bool Sentence::assign(std::string_view text, Refusal* refusal) {
  text_ = text;
  tag_block_ = {};
  field_count_ = 0;
  std::size_t comma = text.find(',');
  const std::string_view address = text.substr(0, comma);
  while (comma != std::string_view::npos) {
    if (field_count_ == kMaxFields) {
      const auto count = static_cast<double>(std::count(text.begin(), text.end(), ','));
      *refusal = {RefusalKind::kFieldCount, "number of fields", count, 0.0, kMaxFields};
      return false;
    }
    begins_[field_count_++] = static_cast<std::uint16_t>(comma + 1);
    comma = text.find(',', comma + 1);
  }
  begins_[field_count_] = static_cast<std::uint16_t>(text.size() + 1);
  return read_address(address, refusal);
}

bool Sentence::read_address(std::string_view address, Refusal* refusal) {
  const std::string_view name = address.substr(std::min<std::size_t>(1, address.size()));
  const bool is_named = std::all_of(name.begin(), name.end(), is_address_character);
  const bool is_of_maker = !name.empty() && name[0] == 'P';
  if (!is_named || (is_of_maker ? name.size() < 2 : name.size() != 5)) {
    *refusal = {RefusalKind::kBadAddress, "address", name,
                "a talker of two characters and a type of three, as GPGGA, or P and a maker's"};
    return false;
  }
  const std::size_t talker_length = is_of_maker ? 1 : 2;
  talker_ = name.substr(0, talker_length);
  type_ = name.substr(talker_length);
  return true;
}

}  // namespace trident::bridges::nmea
