// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace trident::nav {

/// The second pass of a squared distance transform along one row: result[i] is the least of
/// squares[i + reach + dx] + dx^2 for |dx| <= reach, and at most `beyond`. Sums above 65535 count
/// as that. `squares` has count + 2 * reach values; `count` is a multiple of 16. The processor
/// chooses between SSE2 and AVX2 loops, whose results are equal.
void least_squares_in_row(const std::uint16_t* squares, int count, int reach, std::uint16_t beyond,
                          std::uint16_t* result);

}  // namespace trident::nav
