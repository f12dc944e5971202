// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ros_names.h"

#include <algorithm>
#include <cctype>

#include "trident_base/string_util.h"

namespace trident::bridges::modbus {

bool is_name(const std::string& text) {
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
         std::all_of(text.begin(), text.end(), is_word);
}

bool is_topic(const std::string& text) {
  std::size_t begin = starts_with(text, "/") || starts_with(text, "~") ? 1 : 0;
  while (true) {
    const std::size_t slash = text.find('/', begin);
    if (!is_name(text.substr(begin, slash - begin))) return false;
    if (slash == std::string::npos) return true;
    begin = slash + 1;
  }
}

bool is_message_type(const std::string& text) {
  const std::size_t slash = text.find('/');
  return slash != std::string::npos && is_name(text.substr(0, slash)) &&
         is_name(text.substr(slash + 1));
}

}  // namespace trident::bridges::modbus
