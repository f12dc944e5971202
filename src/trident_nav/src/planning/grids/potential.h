// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "planning/grids/bucket_queue.h"
#include "planning/grids/search_result.h"
#include "planning/grids/step_costs.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// The least cost from cells to a goal over the 8-neighbor graph, searched from the goal towards a
/// start (A*), kept between searches and repaired where costs have changed.
///
/// A step costs its length (1 or sqrt 2) times the step cost of the cell that lies farther from the
/// goal; a diagonal step needs both cells next to it. The search stops as soon as the start's
/// potential is exact. A later search for the same goal continues: cells whose least path lost its
/// support are searched again, cells that became cheaper are searched from, and all else stays (the
/// idea of D* Lite, Koenig and Likhachev 2002, with one value per cell and parent pointers).
class Potential {
 public:
  using Result = SearchResult;

  /// `outline`: the cells along the border of the grid are blocked.
  explicit Potential(const StepCosts& costs, bool outline = false);

  /// Searches until the potential at `start` is exact. Both cells lie in the grid; the goal's own
  /// cost is of no influence. The grid's sides have at most 65,000 cells.
  Result search(const CostGrid& grid, Cell goal, Cell start, const CancelFlag& cancel);

  /// The potential in step costs; infinite where nothing is known. Exact at the last start.
  float at(Cell c) const;
  /// Whether the last search has been at the cell.
  bool reached(Cell c) const { return value(c) != kUnreached; }
  /// The cells from the last start to the goal; only after Result::kFound.
  std::vector<Cell> trace() const;
  /// Cells that the last search expanded.
  std::size_t expanded() const { return expanded_.now; }
  /// Forgets everything.
  void clear() { status_.is_ready = false; }

 private:
  static constexpr std::uint32_t kUnreached = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint8_t kOpen = 0x10;
  static constexpr std::uint8_t kRoot = 8;
  static constexpr std::uint32_t kBlockedStep = 0x80000000U;
  /// Values stay below this, so that sums do not wrap around.
  static constexpr std::uint32_t kLimit = 0x7FFFFFFFU;
  static constexpr int kTile = 64;

  /// A cell of the padded grid: x in the low half, y in the high half.
  using Packed = std::uint32_t;
  static constexpr Packed pack(int x, int y) {
    return static_cast<Packed>(y) << 16U | static_cast<Packed>(x);
  }
  static constexpr int x_of(Packed p) { return static_cast<int>(p & 0xFFFFU); }
  static constexpr int y_of(Packed p) { return static_cast<int>(p >> 16U); }
  enum class TileState : std::uint8_t { kUnused, kFilled, kSurrounded };

  struct Status {
    bool is_ready = false;
    bool is_too_long = false;  ///< a path for the scale of the values
  };
  /// In the padded grid.
  struct Ends {
    Cell goal, start;
  };
  struct Expansions {
    std::size_t now = 0, total = 0;  ///< of this search, and since the potential was begun
  };
  /// Values per metre of path cost.
  struct Scale {
    double value = 1.0;
    double coarser = 1.0;  ///< by which it is divided, for paths that would not fit
  };
  /// What a step costs, by the cost of the cell.
  struct StepTable {
    std::array<std::uint32_t, 256> straight{}, diagonal{};
    std::uint32_t least_straight = 0, least_diagonal = 0;
  };
  /// By cell of the padded grid.
  struct CellData {
    std::unique_ptr<std::uint32_t[]> value;
    std::unique_ptr<std::uint8_t[]> cost, state;
    std::size_t allocated = 0;
  };
  /// Squares of kTile cells, which are filled when the search reaches them.
  struct Tiles {
    int x = 0, y = 0;  ///< how many there are
    std::vector<TileState> state;
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x);
  }
  std::size_t index(Packed p) const { return index(x_of(p), y_of(p)); }
  std::uint32_t value(Cell c) const;
  std::uint32_t heuristic(int x, int y) const;
  void allocate(const GridGeometry& geometry);
  void begin(const CostGrid& grid, Cell goal);
  void choose_scale(double coarser);
  void fill_tile(int tile_x, int tile_y);
  void surround(int x, int y);
  bool repair();
  void find_changes(std::vector<Packed>& changed);
  void compare_row(int x0, int y, std::vector<Packed>& changed);
  bool invalidate(const std::vector<Packed>& changed, std::vector<Packed>& invalid);
  void seed_invalid(Packed p, std::vector<Packed>& stack);
  void drop(Packed p, std::vector<Packed>& stack);
  void offer_from_neighbors(Packed p);
  void reopen_around(Packed p);
  void aim(Cell start);
  Result run(const CancelFlag& cancel);
  void expand(Packed p);
  void relax(std::size_t from, int x, int y, std::uint8_t parent, std::uint32_t length);
  void open(int x, int y, std::size_t i);
  std::uint8_t source_cost(int x, int y) const;

  StepCosts costs_;
  bool outline_;
  Status status_;
  Expansions expanded_;
  const CostGrid* source_ = nullptr;  ///< Only during a search.
  GridGeometry geometry_;
  std::uint64_t revision_ = 0;
  Ends ends_;
  Scale scale_;
  StepTable steps_;
  std::size_t stride_ = 0;
  std::array<std::ptrdiff_t, 8> offset_{};
  CellData cells_;
  Tiles tiles_;
  BucketQueue<Packed> queue_;
};

// Octile distance at the lowest step cost: never above the true cost, and consistent.
inline std::uint32_t Potential::heuristic(int x, int y) const {
  const auto dx = static_cast<std::uint32_t>(std::abs(x - ends_.start.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(y - ends_.start.y));
  const std::uint32_t most = std::max(dx, dy);
  const std::uint32_t least = std::min(dx, dy);
  return steps_.least_straight * (most - least) + steps_.least_diagonal * least;
}

inline void Potential::relax(std::size_t from, int x, int y, std::uint8_t parent,
                             std::uint32_t length) {
  const std::size_t i = index(x, y);
  const std::uint32_t v = cells_.value[from] + length;
  if (v >= cells_.value[i]) return;
  if (v >= kLimit) {
    status_.is_too_long = true;
    return;
  }
  cells_.value[i] = v;
  cells_.state[i] = parent;
  open(x, y, i);
}

inline void Potential::open(int x, int y, std::size_t i) {
  cells_.state[i] |= kOpen;
  queue_.push(std::uint64_t{cells_.value[i]} + heuristic(x, y), pack(x, y));
}

}  // namespace trident::nav
