// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "trident_bridges/modbus/pdu.h"

namespace trident::bridges::modbus {

/// The bytes that hexadecimal numbers stand for: "03 00 6B".
inline std::vector<std::uint8_t> bytes_of(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  std::istringstream words(hex);
  for (std::string word; words >> word;) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(word, nullptr, 16)));
  }
  return bytes;
}

/// The other direction.
inline std::string hex_of(Bytes bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    char word[4];
    std::snprintf(word, sizeof(word), "%02X ", byte);
    text += word;
  }
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace trident::bridges::modbus
