// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planning/grids/step_costs.h"
#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// Which cells of a grid are blocked, as bits in lines (the rows, or the columns), and jumps along
/// a line that look at 64 cells at a time (Harabor and Grastien, "Improving Jump Point Search",
/// ICAPS 2014). Beyond its ends all is blocked.
class JumpScan {
 public:
  static constexpr int kNone = -1;

  /// `lines` of `length` cells, none of them blocked.
  void reset(int lines, int length);
  void block(int line, int at) {
    bits_[word(line, at + kPad)] |= std::uint64_t{1} << (static_cast<unsigned>(at + kPad) % 64U);
  }
  bool blocked(int line, int at) const { return (window(line, at) & 1U) != 0; }

  /// The first cell after `at` towards greater (`step` 1) or smaller (-1) numbers that is `target`
  /// or has to be looked at, because a cell next to it is free while the one before that is
  /// blocked: no shorter path leads there. kNone: a blocked cell comes first. `target` may be
  /// kNone.
  int jump(int line, int at, int step, int target) const {
    return step > 0 ? jump_up(line, at, target) : jump_down(line, at, target);
  }

 private:
  // Cells of blocked border before the first cell of a line; a word more is read after its last.
  static constexpr int kPad = 64;

  std::size_t word(int line, int padded) const {
    return static_cast<std::size_t>(line + 1) * words_ + static_cast<std::size_t>(padded) / 64U;
  }
  /// The cells from `first` on, 64 of them, the lowest bit first.
  std::uint64_t window(int line, int first) const {
    const int padded = first + kPad;
    const std::size_t w = word(line, padded);
    const unsigned shift = static_cast<unsigned>(padded) % 64U;
    return shift == 0 ? bits_[w] : bits_[w] >> shift | bits_[w + 1] << (64U - shift);
  }
  int jump_up(int line, int at, int target) const;
  int jump_down(int line, int at, int target) const;

  std::vector<std::uint64_t> bits_;
  std::size_t words_ = 0;  ///< Of a line.
};

}  // namespace trident::nav
