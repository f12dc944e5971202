// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "planning/grids/bucket_queue.h"
#include "planning/potential/potential.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// A search from the start over the grid's own costs, led by a kept potential whose known costs are
/// nowhere above them: A* with a heuristic that is exact but for what has become dearer (the idea
/// of Koenig and Likhachev, "Adaptive A*", AAMAS 2005). It spreads only where a dearer cell is in
/// the path, and ends where the potential's path from a cell to the goal is as it was.
class StartSearch {
 public:
  enum class Result { kFound, kBound, kTooLong, kNoPath, kCanceled };
  struct Limits {
    /// A path that costs as much is known [values of the potential]: the search ends with kBound
    /// once none can cost less. The greatest value: none is known.
    std::uint32_t bound = std::numeric_limits<std::uint32_t>::max();
    std::size_t expansions = 0;  ///< After so many cells it ends with kTooLong.
  };

  /// `outline`: the cells along the border of the grid are blocked.
  explicit StartSearch(bool outline) : edge_(outline ? 1 : 0) {}

  /// Searches between the ends of the potential, which has just been searched with known costs.
  Result search(const CostGrid& grid, const Potential& potential, const Limits& limits,
                const CancelFlag& cancel);
  /// The cells from the start to the goal, and what they cost in the grid [values of the
  /// potential]; after Result::kFound.
  std::vector<Cell> path() const;
  std::uint32_t cost() const { return best_.cost; }
  /// Cells that the last search expanded.
  std::size_t expanded() const { return expanded_; }

 private:
  static constexpr std::uint32_t kUnreached = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint8_t kRoot = 8;
  static constexpr int kSide = 16;
  /// What is known of the potential's path from a cell on.
  enum class Tail : std::uint8_t { kNotSeen, kFree, kDearer };
  struct Node {
    std::uint32_t value = kUnreached;  ///< The cost of a path from the start.
    std::uint8_t parent = kRoot;       ///< The direction of the cell before.
    bool is_closed = false;
    Tail tail = Tail::kNotSeen;
  };
  using Tile = std::array<Node, std::size_t{kSide} * kSide>;
  /// The cell at which the best path that is known joins that of the potential.
  struct Best {
    std::uint32_t cost = kUnreached;
    Cell cell;
  };
  using Packed = std::uint32_t;
  static constexpr Packed pack(Cell c) {
    return static_cast<Packed>(c.y) << 16U | static_cast<Packed>(c.x);
  }
  static constexpr Cell unpack(Packed p) {
    return {static_cast<int>(p & 0xFFFFU), static_cast<int>(p >> 16U)};
  }

  void begin();
  Result run(const CancelFlag& cancel);
  void join(Cell c, std::uint32_t value);
  bool is_tail_free(Cell c);
  void expand(Cell c, std::uint32_t value);
  void relax(Cell c, std::uint32_t value, int parent);
  bool is_inside(Cell c) const;
  bool is_free(Cell c) const;
  Node& node(Cell c);
  std::size_t tile_of(Cell c) const;

  int edge_;
  Limits limits_;
  const CostGrid* grid_ = nullptr;        ///< Only during a search.
  const Potential* potential_ = nullptr;  ///< Of the last search.
  std::size_t columns_ = 0;               ///< Of tiles.
  std::vector<std::uint32_t> numbers_;    ///< Of the tiles that are in use, from 1 on; or 0.
  std::vector<std::size_t> used_;         ///< Which of them are not 0.
  std::vector<Tile> tiles_;
  BucketQueue<Packed> queue_;
  Best best_;
  std::size_t expanded_ = 0;
};

}  // namespace trident::nav
