// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/jump_scan.h"

namespace trident::nav {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

int lowest_bit(std::uint64_t bits) { return __builtin_ctzll(bits); }
int highest_bit(std::uint64_t bits) { return 63 - __builtin_clzll(bits); }

}  // namespace

void JumpScan::reset(int lines, int length) {
  words_ = static_cast<std::size_t>(length + kPad + 63) / 64U + 2;
  bits_.assign(static_cast<std::size_t>(lines + 2) * words_, kAll);
  for (int line = 0; line < lines; ++line) {
    std::size_t w = word(line, kPad);
    for (int left = length; left > 0; left -= 64, ++w) {
      bits_[w] = left >= 64 ? 0 : kAll << static_cast<unsigned>(left);
    }
  }
}

// Bit k of a window stands for cell first + k; shifted windows bring each cell's predecessor to its
// own place.
int JumpScan::jump_up(int line, int at, int target) const {
  for (int first = at + 1;; first += 64) {
    const std::uint64_t walls = window(line, first);
    const std::uint64_t openings = (window(line - 1, first - 1) & ~window(line - 1, first)) |
                                   (window(line + 1, first - 1) & ~window(line + 1, first));
    const std::uint64_t stops = walls | openings;
    const int stop = stops == 0 ? first + 64 : first + lowest_bit(stops);
    if (target > at && target >= first && target < stop) return target;
    if (stops != 0) return (walls >> static_cast<unsigned>(stop - first) & 1U) != 0 ? kNone : stop;
  }
}

int JumpScan::jump_down(int line, int at, int target) const {
  for (int last = at - 1;; last -= 64) {
    const int first = last - 63;
    const std::uint64_t walls = window(line, first);
    const std::uint64_t openings = (window(line - 1, first + 1) & ~window(line - 1, first)) |
                                   (window(line + 1, first + 1) & ~window(line + 1, first));
    const std::uint64_t stops = walls | openings;
    const int stop = stops == 0 ? first - 1 : first + highest_bit(stops);
    if (target != kNone && target <= last && target > stop) return target;
    if (stops != 0) return (walls >> static_cast<unsigned>(stop - first) & 1U) != 0 ? kNone : stop;
  }
}

}  // namespace trident::nav
