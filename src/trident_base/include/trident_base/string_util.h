// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trident {

/// "a, b, c".
std::string join(const std::vector<std::string>& parts, std::string_view separator = ", ");

/// True for an empty prefix.
inline bool starts_with(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}
/// True for an empty suffix.
inline bool ends_with(std::string_view text, std::string_view suffix) {
  return text.size() >= suffix.size() && text.substr(text.size() - suffix.size()) == suffix;
}

/// Shortest decimal text that reads back as the same double; "inf", "-inf", "nan" otherwise.
std::string number_text(double value);

/// The number that the whole text is, as std::stod reads it: white space may come before it, "inf"
/// and "nan" are numbers; nullopt if there is no number, or if it is out of a double's range.
std::optional<double> number_from_text(const std::string& text);

/// Number of single-character insertions, deletions, replacements and swaps of neighbours that lead
/// from a to b, without regard to case (optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `name`; empty when none is near enough to be a likely typing error.
std::string closest_match(std::string_view name, const std::vector<std::string>& candidates);

/// "'forse'; did you mean 'force'? Known: force, mass".
std::string unknown_name_text(std::string_view name, const std::vector<std::string>& known);

}  // namespace trident
