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

}  // namespace

std::string with_short_words(const std::string& text) {
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
