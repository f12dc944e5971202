// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// The loops of the first pass of the distance transform, over rows of the table that holds how
/// many rows away each column's nearest seed is.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/byte_rows.h"

namespace trident::nav {

/// 255 where a cost is that of a seed, else 0: lethal is 254 and unknown 255.
inline Bytes seeds_among(const Bytes& cost, bool is_unknown_seed) {
  const Bytes last = all_bytes(is_unknown_seed ? 255 : 254);
  return static_cast<Bytes>((cost >= all_bytes(254)) & (cost <= last));
}

/// Rows to the nearest seed at or below each cell of a row: 0 where `cost` is a seed, else one more
/// than in the row below (`before`), and at most `none`.
inline void advance_rows(const std::uint8_t* cost, const std::uint8_t* before, std::uint8_t none,
                         bool is_unknown_seed, int count, std::uint8_t* rows) {
  std::memcpy(rows, before, static_cast<std::size_t>(count));
  combine_row(cost, count, rows, [&](const Bytes& down, const Bytes& value) {
    const Bytes one_more = smaller(down + all_bytes(1), all_bytes(none));
    return one_more & ~seeds_among(value, is_unknown_seed);
  });
}

/// Lowers a row to one more than the row above it.
inline void limit_rows(const std::uint8_t* above, int count, std::uint8_t* rows) {
  combine_row(above, count, rows,
              [](const Bytes& row, const Bytes& up) { return smaller(row, up + all_bytes(1)); });
}

inline bool all_equal(const std::uint8_t* values, int count, std::uint8_t value) {
  Bytes differs{};
  int i = 0;
  for (; i + 16 <= count; i += 16) differs |= load_bytes(values + i) ^ all_bytes(value);
  if (any_bit(differs)) return false;
  for (; i < count; ++i) {
    if (values[i] != value) return false;
  }
  return true;
}

/// Squares of `count` numbers of rows; those above `reach` become 65535.
inline void square_rows(const std::uint8_t* rows, int count, int reach, std::uint16_t* squares) {
  using Half = std::uint8_t __attribute__((vector_size(8)));
  using Words = std::uint16_t __attribute__((vector_size(16)));
  const Words most = Words{} + static_cast<std::uint16_t>(reach);
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    Half half;
    std::memcpy(&half, rows + i, sizeof half);
    const Words wide = __builtin_convertvector(half, Words);
    const Words square = (wide * wide) | static_cast<Words>(wide > most);
    std::memcpy(squares + i, &square, sizeof square);
  }
  for (; i < count; ++i) {
    squares[i] = static_cast<std::uint16_t>(rows[i] > reach ? 65535 : rows[i] * rows[i]);
  }
}

}  // namespace trident::nav
