// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace trident {

/// The value that is written as `text` behind the option, or in the environment variable, of this
/// name. Throws Error naming the option and `text` unless the whole text is a number in [lo, hi].
double option_number(const std::string& option, const std::string& text, double lo, double hi);

/// The integer that is written as `text` (1e3 is one, too). Throws Error on the same conditions,
/// and unless the number is an integer; requires |lo|, |hi| <= 2^53, where a double is exact.
std::int64_t option_count(const std::string& option, const std::string& text, std::int64_t lo,
                          std::int64_t hi);

}  // namespace trident
