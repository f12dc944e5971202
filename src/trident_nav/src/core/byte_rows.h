// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Loops over rows of cells, sixteen at once. The vectors are those of GCC and clang, which become
/// SSE2 or NEON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace trident::nav {

using Bytes = std::uint8_t __attribute__((vector_size(16)));

inline Bytes load_bytes(const std::uint8_t* p) {
  Bytes result;
  std::memcpy(&result, p, sizeof result);
  return result;
}
inline void store_bytes(std::uint8_t* p, const Bytes& bytes) {
  std::memcpy(p, &bytes, sizeof bytes);
}
inline Bytes all_bytes(std::uint8_t value) { return Bytes{} + value; }

inline Bytes larger(const Bytes& a, const Bytes& b) { return a > b ? a : b; }
inline Bytes smaller(const Bytes& a, const Bytes& b) { return a < b ? a : b; }

/// The higher of two costs where unknown, 255, is lower than all others: costmap_2d's combination
/// by maximum.
inline Bytes maximum_of_known(const Bytes& a, const Bytes& b) {
  const Bytes one = all_bytes(1);  // 255 + 1 wraps to 0
  return larger(a + one, b + one) - one;
}

inline bool any_bit(const Bytes& bytes) {
  std::uint64_t parts[2];
  std::memcpy(parts, &bytes, sizeof parts);
  return (parts[0] | parts[1]) != 0;
}

/// Copies up to sixteen cells; false when they were equal already.
inline bool replace_block(const std::uint8_t* from, int count, std::uint8_t* to) {
  if (count == 16) {
    const Bytes value = load_bytes(from);
    if (!any_bit(value ^ load_bytes(to))) return false;
    store_bytes(to, value);
    return true;
  }
  if (std::memcmp(from, to, static_cast<std::size_t>(count)) == 0) return false;
  std::memcpy(to, from, static_cast<std::size_t>(count));
  return true;
}

/// to[i] = operation(to[i], from[i]) for `count` cells.
template <class Operation>
void combine_row(const std::uint8_t* from, int count, std::uint8_t* to, Operation operation) {
  int i = 0;
  for (; i + 16 <= count; i += 16) {
    store_bytes(to + i, operation(load_bytes(to + i), load_bytes(from + i)));
  }
  if (i == count) return;
  const auto rest = static_cast<std::size_t>(count - i);
  Bytes a{}, b{};
  std::memcpy(&a, to + i, rest);
  std::memcpy(&b, from + i, rest);
  const Bytes c = operation(a, b);
  std::memcpy(to + i, &c, rest);
}

}  // namespace trident::nav
