// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace trident {

/// The value that is written as `text` behind the option, or in the environment variable, of this
/// name. Throws Error naming the option and `text` unless the whole text is a number in [lo, hi].
double option_number(const std::string& option, const std::string& text, double lo, double hi);

/// The whole number that is written so, 1e3 included. Throws Error likewise; lo and hi within
/// +-2^53, where a double holds every whole number.
std::int64_t option_count(const std::string& option, const std::string& text, std::int64_t lo,
                          std::int64_t hi);

}  // namespace trident
