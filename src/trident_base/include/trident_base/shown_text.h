// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace trident {

/// Longest word of bad input that a message shows.
inline constexpr std::size_t kLongestShownWord = 200;

/// A message about bad input with every word of more than `kLongestShownWord` bytes cut, which
/// "..." marks. Paths stay whole: they are no bad input, and name the place. Control characters but
/// ends of lines and tabs, and bytes that are not UTF-8, are written as \x1b: a terminal would obey
/// the former.
std::string with_short_words(const std::string& text);

}  // namespace trident
