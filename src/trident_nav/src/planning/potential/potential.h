// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "planning/grids/bucket_queue.h"
#include "planning/grids/search_result.h"
#include "planning/grids/step_costs.h"
#include "planning/potential/potential_cells.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// The least cost from cells to a goal over the 8-neighbor graph, searched from the goal towards a
/// start (A*), kept between searches and repaired where costs have changed.
///
/// A step costs its length (1 or sqrt 2) times the step cost of the cell that lies farther from the
/// goal; a diagonal step needs both cells next to it. The search stops as soon as the start's
/// potential is exact. From a cell it continues only to those neighbors that its predecessor does
/// not reach as cheaply without it, of equal paths taking those whose diagonal steps come first
/// (the pruning of Harabor and Grastien, "Online Graph Pruning for Pathfinding on Grid Maps", AAAI
/// 2011, with costs).
///
/// A later search for the same goal continues: cells that became cheaper are searched from, cells
/// that became dearer count as what they were until a path is found that leads over them, and then
/// the cells whose least path lost its support are searched again; all else stays (the idea of
/// D* Lite, Koenig and Likhachev 2002, with one value per cell and parent pointers).
class Potential {
 public:
  using Result = SearchResult;
  /// Which costs a search is about: the grid's, or those that are known, none of which is dearer.
  enum class Costs { kOfGrid, kKnown };

  /// `outline`: the cells along the border of the grid are blocked.
  explicit Potential(const StepCosts& costs, bool outline = false);

  /// Searches until the potential at `start` is exact. Both cells lie in the grid; the goal's own
  /// cost is of no influence. The grid's sides have at most 65,000 cells. With known costs alone
  /// the potential is not above that in the grid, and the path may lead over blocked cells.
  Result search(const CostGrid& grid, Cell goal, Cell start, const CancelFlag& cancel,
                Costs costs = Costs::kOfGrid);
  /// Whether a step of a path enters or passes cells that are dearer in the grid than is known. The
  /// path is one of `trace`.
  bool is_dearer(const CostGrid& grid, Cell from, Cell to) const;

  /// The potential in step costs; infinite where nothing is known. Exact at the last start; away
  /// from its path it may not know yet of cells that became dearer.
  float at(Cell c) const;
  /// Whether a search for this goal has been at the cell.
  bool reached(Cell c) const { return value(c) != kUnreached; }
  /// The cells from the last start to the goal; only after Result::kFound.
  std::vector<Cell> trace() const;
  /// Cells that the last search expanded.
  std::size_t expanded() const { return expanded_.now; }
  /// Cells that were expanded since the potential was begun.
  std::size_t total_expanded() const { return expanded_.total; }
  /// Forgets everything.
  void clear() { status_.is_ready = false; }

  // What a search from the start needs, after one with known costs that has found a path. Values
  // are whole numbers: costs times `scale`.

  /// What a step costs, by the cost of the cell.
  struct StepTable {
    std::array<std::uint32_t, 256> straight{}, diagonal{};
    std::uint32_t least_straight = 0, least_diagonal = 0;
  };
  static constexpr std::uint32_t kBlockedStep = 0x80000000U;
  const StepTable& steps() const { return steps_; }
  double scale() const { return scale_.value; }
  Cell start() const { return {ends_.start.x - 1, ends_.start.y - 1}; }
  Cell goal() const { return {ends_.goal.x - 1, ends_.goal.y - 1}; }
  struct Bound {
    std::uint32_t value;  ///< No path from the cell costs less.
    bool is_exact;        ///< One costs as much by the known costs.
  };
  /// What remains of the path. Consistent: never above a step and what remains after it.
  Bound bound(Cell c) const;
  /// The next cell on the path from a cell whose bound is exact; none at the goal.
  std::optional<Cell> next(Cell c) const;

 private:
  using Node = PotentialCells::Node;
  static constexpr std::uint32_t kUnreached = PotentialCells::kUnreached;
  static constexpr std::uint8_t kRoot = PotentialCells::kRoot;
  /// Values stay below this, so that sums do not wrap around.
  static constexpr std::uint32_t kLimit = 0x7FFFFFFFU;

  /// Cells are expanded out of turn up to a key of so many cheapest steps above the lowest.
  static constexpr unsigned kAllowance = 16;
  /// How many cells ahead of the one that is expanded are prefetched.
  static constexpr std::size_t kPrefetch = 6;

  /// A cell of the padded grid: x in the low half, y in the high half.
  using Packed = std::uint32_t;
  static constexpr Packed pack(int x, int y) {
    return static_cast<Packed>(y) << 16U | static_cast<Packed>(x);
  }
  static constexpr int x_of(Packed p) { return static_cast<int>(p & 0xFFFFU); }
  static constexpr int y_of(Packed p) { return static_cast<int>(p >> 16U); }

  struct Status {
    bool is_ready = false;
    bool is_too_long = false;  ///< a path for the scale of the values
    bool has_dearer = false;   ///< cells that are dearer in the grid than is known
  };
  /// In the padded grid.
  struct Ends {
    Cell goal, start;
  };
  struct Expansions {
    std::size_t now = 0, total = 0;  ///< of this search, and since the potential was begun
    std::size_t dropped = 0;         ///< cells that have lost their value in this search
  };
  /// Values per metre of path cost.
  struct Scale {
    double value = 1.0;
    double coarser = 1.0;  ///< by which it is divided, for paths that would not fit
  };
  /// A cell that is expanded, and those around it.
  struct Around {
    Node* node;
    int x, y;
    const PotentialCells::Offsets* offsets;
    Node& next(int d) const { return node[(*offsets)[static_cast<std::size_t>(d)]]; }
    std::uint8_t cost(int d) const { return next(d).cost; }
    Packed packed(int d) const {
      return pack(x + kDx[static_cast<std::size_t>(d)], y + kDy[static_cast<std::size_t>(d)]);
    }
  };
  using Cells = std::vector<Packed>;

  std::size_t index(Packed p) const { return cells_.index(x_of(p), y_of(p)); }
  std::uint32_t value(Cell c) const;
  std::uint32_t heuristic(int x, int y) const { return distance({x, y}, ends_.start); }
  std::uint32_t distance(Cell a, Cell b) const;
  std::uint64_t key(int x, int y, std::uint32_t value) const {
    return std::uint64_t{value} + heuristic(x, y) + lead_;
  }
  std::uint32_t straight(std::uint8_t cost) const { return steps_.straight[cost]; }
  std::uint32_t diagonal(std::uint8_t cost) const { return steps_.diagonal[cost]; }
  bool is_blocked(std::uint8_t cost) const { return steps_.straight[cost] == kBlockedStep; }
  Around around(int x, int y);
  void prefetch(Packed p) const;

  void begin(Cell goal, Cell start);
  void choose_scale(double coarser);
  bool is_kept(const CostGrid& grid, Cell goal_inside) const;
  void aim(Cell start);
  Result run(const CancelFlag& cancel, Costs costs);
  Result run_on_known_costs(const CancelFlag& cancel);
  void expand_run(Packed p, std::uint64_t limit);
  bool advance(Around& at, int direction, std::uint64_t limit);
  bool expand_straight(const Around& at, int arrival);
  bool expand_diagonal(const Around& at, int arrival);
  void expand_all(const Around& at);
  void relax(const Around& from, int direction, std::uint32_t length);
  void set(Node& node, std::uint32_t value, int parent, Packed p);
  static bool can_cut(const std::array<bool, 4>& free, int diagonal) {
    const auto& cut = kCut[static_cast<std::size_t>(diagonal - 4)];
    return free[static_cast<std::size_t>(cut[0])] && free[static_cast<std::size_t>(cut[1])];
  }
  void open(int x, int y, Node& node);

  void take_changes();
  void take_costs(const Cells& cells);
  bool is_dearer_at(const CostGrid& grid, int x, int y) const;
  bool raise_under_path();
  bool raise_about(Cell c);
  bool invalidate(const Cells& dearer, Cells& invalid);
  void seed_invalid(Packed p, Cells& stack);
  void drop(Packed p, Cells& stack);
  void offer_from_neighbors(Packed p);
  void reopen_around(Packed p);

  StepCosts costs_;
  Status status_;
  Expansions expanded_;
  const CostGrid* source_ = nullptr;  ///< Only during a search.
  GridGeometry geometry_;
  std::uint64_t revision_ = 0;
  Ends ends_;
  Scale scale_;
  StepTable steps_;
  /// By how much keys in the queue may be too high for the start that they were made for: the sum
  /// of the distances between starts (D* Lite's key modifier).
  std::uint64_t lead_ = 0;
  PotentialCells cells_;
  BucketQueue<Packed> queue_;
};

}  // namespace trident::nav
