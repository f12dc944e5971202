// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/string_util.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <exception>

#include "trident_base/shown_text.h"

namespace trident {
namespace {

constexpr std::size_t kMinPrefix = 3;

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool is_prefix(const std::string& a, const std::string& b) {
  return a.size() >= kMinPrefix && starts_with(b, a);
}

}  // namespace

std::string join(const std::vector<std::string>& parts, std::string_view separator) {
  std::string result;
  for (const std::string& part : parts) {
    if (&part != &parts.front()) result += separator;
    result += part;
  }
  return result;
}

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  // The shortest decimal number that is read back as the same double has at most 24 characters.
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::optional<double> number_from_text(const std::string& text) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size()) return value;
  } catch (const std::exception&) {  // no number, or none that a double can hold
  }
  return std::nullopt;
}

namespace {

/// Whether the last two letters of the prefixes, of `i` and `j` letters, have changed places.
bool ends_in_swap(const std::string& s, std::size_t i, const std::string& t, std::size_t j) {
  return i > 1 && j > 1 && s[i - 1] == t[j - 2] && s[i - 2] == t[j - 1];
}

}  // namespace

/// Optimal string alignment: insertions, deletions, replacements and swaps of neighbors count one.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::string s = lower_case(a);
  const std::string t = lower_case(b);
  // Three rows of the dynamic programming table: i - 2, i - 1 and i.
  std::vector<std::size_t> before(t.size() + 1), previous(t.size() + 1), row(t.size() + 1);
  for (std::size_t j = 0; j <= t.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= s.size(); ++i) {
    before.swap(previous);
    previous.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= t.size(); ++j) {
      const std::size_t replaced = previous[j - 1] + (s[i - 1] == t[j - 1] ? 0 : 1);
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, replaced});
      // A swap is one slip of the fingers, though two replacements.
      if (ends_in_swap(s, i, t, j)) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[t.size()];
}

std::string closest_match(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.size() > kLongestShownWord) return "";  // no slip, and the distance takes its square
  const std::string key = lower_case(name);
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::string other = lower_case(candidate);
    const bool is_part = is_prefix(key, other) || is_prefix(other, key);
    // An abbreviation is a likely error, but a weaker match than any small slip.
    const std::size_t limit = std::max<std::size_t>(1, name.size() / 3);
    const std::size_t distance =
        is_part ? std::min(edit_distance(key, other), limit) : edit_distance(key, other);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string unknown_name_text(std::string_view name, const std::vector<std::string>& known) {
  std::string text = '\'' + with_short_words(std::string(name)) + '\'';
  const std::string nearest = closest_match(name, known);
  if (!nearest.empty()) text += "; did you mean '" + nearest + "'?";
  return text + (nearest.empty() ? "; known: " : " Known: ") +
         (known.empty() ? "none" : join(known));
}

}  // namespace trident
