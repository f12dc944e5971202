// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/shown_text.h"

#include <algorithm>

namespace trident {
namespace {

constexpr char kSpaces[] = " \t\r\n";
constexpr std::size_t kLongestPath = 4096;

bool is_path(const std::string& text, std::size_t begin, std::size_t end) {
  const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = text.begin() + static_cast<std::ptrdiff_t>(end);
  return end - begin <= kLongestPath && std::find(first, last, '/') != last;
}

/// How many bytes of a long word are shown, so that no UTF-8 character is cut.
std::size_t whole_characters(const std::string& text, std::size_t begin) {
  std::size_t size = kLongestShownWord;
  while (size > 0 && (text[begin + size] & 0xC0) == 0x80) --size;
  return size;
}

/// Bytes of the UTF-8 character that begins there (RFC 3629, table in section 4, but for surrogates
/// and overlong forms of three and four bytes); 0: none does.
std::size_t character_size(const std::string& text, std::size_t begin) {
  const auto lead = static_cast<unsigned char>(text[begin]);
  const std::size_t size = lead < 0x80                   ? 1
                           : lead >= 0xC2 && lead < 0xE0 ? 2
                           : lead >= 0xE0 && lead < 0xF0 ? 3
                           : lead >= 0xF0 && lead < 0xF5 ? 4
                                                         : 0;
  if (begin + size > text.size()) return 0;
  const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto is_following = [](char byte) { return (byte & 0xC0) == 0x80; };
  const auto last = first + static_cast<std::ptrdiff_t>(size);
  return std::all_of(std::min(first + 1, last), last, is_following) ? size : 0;
}

bool is_control(char byte) {
  const auto code = static_cast<unsigned char>(byte);
  return (code < 0x20 && byte != '\n' && byte != '\t') || code == 0x7F;
}

std::string escaped(const std::string& text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = character_size(text, at);
    if (size == 0 || is_control(text[at])) {
      const auto code = static_cast<unsigned char>(text[at++]);
      shown += {'\\', 'x', kDigits[code >> 4], kDigits[code & 0xF]};
      continue;
    }
    shown.append(text, at, size);
    at += size;
  }
  return shown;
}

}  // namespace

std::string with_short_words(const std::string& raw) {
  std::string text = escaped(raw);
  if (text.size() <= kLongestShownWord) return text;
  std::string shown;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t begin = std::min(text.find_first_not_of(kSpaces, at), text.size());
    const std::size_t end = std::min(text.find_first_of(kSpaces, begin), text.size());
    shown.append(text, at, begin - at);
    const bool is_long = end - begin > kLongestShownWord && !is_path(text, begin, end);
    shown.append(text, begin, is_long ? whole_characters(text, begin) : end - begin);
    if (is_long) shown += "...";
    at = end;
  }
  return shown;
}

}  // namespace trident
