// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/potential/potential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planning/reference_search.h"
#include "trident_base/random_stream.h"

namespace trident::nav {
namespace {

using testing::reference_potential;
using testing::TestGrid;

StepCosts weighted_costs() {
  StepCosts costs;
  for (int c = 0; c <= 252; ++c) costs.step[c] = 50.0F + 0.8F * static_cast<float>(c);
  return costs;
}

/// Costs in patches of a few cells, a fifth of them blocked.
class RandomGrid {
 public:
  RandomGrid(int seed, int width, int height) : stream_(seed, "grid"), grid(width, height) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) grid(x, y) = cost();
    }
  }
  int number(int below) { return static_cast<int>(stream_.uniform(next_++, 0) * below); }
  std::uint8_t cost() {
    const int kind = number(10);
    if (kind < 5) return kFreeCost;
    if (kind < 8) return static_cast<std::uint8_t>(number(253));
    return kLethalCost;
  }
  Cell free_cell() {
    while (true) {
      const Cell c{number(grid.geometry.width), number(grid.geometry.height)};
      if (grid(c.x, c.y) < kInscribedCost) return c;
    }
  }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;

 public:
  TestGrid grid;
};

void expect_exact(Potential& potential, const TestGrid& grid, Cell goal, Cell start) {
  const CancelFlag cancel{false};
  const CostGrid view = grid.view();
  const double expected =
      reference_potential(view, weighted_costs(), goal)[view.geometry.index(start)];
  const auto result = potential.search(view, goal, start, cancel);
  if (std::isinf(expected)) {
    EXPECT_EQ(result, Potential::Result::kNoPath);
    return;
  }
  ASSERT_EQ(result, Potential::Result::kFound);
  EXPECT_NEAR(potential.at(start), expected, 5e-5 * expected);
  const std::vector<Cell> cells = potential.trace();
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    sum += weighted_costs().step[view.at(cells[i])] *
           std::hypot(cells[i].x - cells[i + 1].x, cells[i].y - cells[i + 1].y);
  }
  EXPECT_NEAR(sum, expected, 1e-5 * expected);
  EXPECT_TRUE(cells.back() == goal);
}

TEST(Potential, EqualsDijkstraOnRandomGrids) {
  for (int seed = 0; seed < 40; ++seed) {
    RandomGrid random(seed, 70 + seed, 90);
    Potential potential(weighted_costs());
    expect_exact(potential, random.grid, random.free_cell(), random.free_cell());
  }
}

TEST(Potential, IsExactAfterEveryRepair) {
  for (int seed = 0; seed < 30; ++seed) {
    RandomGrid random(100 + seed, 100, 80);
    Potential potential(weighted_costs());
    const Cell goal = random.free_cell();
    for (int step = 0; step < 12; ++step) {
      expect_exact(potential, random.grid, goal, random.free_cell());
      for (int change = 0; change < 1 + 40 * (step % 3); ++change) {
        const Cell c{random.number(100), random.number(80)};
        if (!(c == goal)) random.grid(c.x, c.y) = random.cost();
      }
    }
  }
}

/// Mostly free ground with boxes, and costs that fall off around them as in an inflated costmap.
class BoxGrid : public RandomGrid {
 public:
  BoxGrid(int seed, int width, int height) : RandomGrid(seed, width, height) {
    std::fill(grid.cost.begin(), grid.cost.end(), kFreeCost);
    for (int box = 0; box < width * height / 900; ++box) add_box();
  }
  void add_box() { stamp(number(8) + 1, number(8) + 1, kLethalCost); }
  void clear_box() { stamp(number(20) + 1, number(20) + 1, kFreeCost); }

 private:
  void stamp(int wide, int high, std::uint8_t core) {
    const int x0 = number(grid.geometry.width), y0 = number(grid.geometry.height);
    for (int y = std::max(0, y0 - 6); y < std::min(grid.geometry.height, y0 + high + 6); ++y) {
      for (int x = std::max(0, x0 - 6); x < std::min(grid.geometry.width, x0 + wide + 6); ++x) {
        const int dx = std::max({0, x0 - x, x - x0 - wide + 1});
        const int dy = std::max({0, y0 - y, y - y0 - high + 1});
        const double falling = 252.0 * std::exp(-0.4 * std::hypot(dx, dy));
        if (core == kFreeCost) grid(x, y) = kFreeCost;
        if (core == kFreeCost || grid(x, y) == kLethalCost) continue;
        const auto cost = dx + dy == 0 ? core : static_cast<std::uint8_t>(falling);
        grid(x, y) = std::max(grid(x, y), cost);
      }
    }
  }
};

TEST(Potential, EqualsDijkstraWhereCostsAreEqualOrFallOff) {
  for (int seed = 0; seed < 20; ++seed) {
    BoxGrid random(200 + seed, 190, 140);
    Potential potential(weighted_costs());
    expect_exact(potential, random.grid, random.free_cell(), random.free_cell());
  }
}

TEST(Potential, IsExactWhileBoxesComeAndGoAndTheStartMoves) {
  for (int seed = 0; seed < 12; ++seed) {
    BoxGrid random(300 + seed, 190, 140);
    Potential potential(weighted_costs());
    const Cell goal = random.free_cell();
    Cell start = random.free_cell();
    for (int step = 0; step < 15; ++step) {
      expect_exact(potential, random.grid, goal, start);
      for (int box = 0; box < step % 4; ++box) {
        random.add_box();
        random.clear_box();
      }
      random.grid(goal.x, goal.y) = kFreeCost;
      const Cell near{start.x + random.number(5) - 2, start.y + random.number(5) - 2};
      if (random.grid.geometry.contains(near)) start = near;
    }
  }
}

TEST(Potential, AStartThatFollowsThePathNeedsNoSearch) {
  BoxGrid random(7, 190, 140);
  Potential potential(weighted_costs());
  const Cell goal = random.free_cell();
  expect_exact(potential, random.grid, goal, random.free_cell());
  const std::vector<Cell> path = potential.trace();
  for (std::size_t i = 1; i < path.size(); i += 5) {
    expect_exact(potential, random.grid, goal, path[i]);
    EXPECT_EQ(potential.expanded(), 0U);
  }
}

TEST(Potential, WhatGetsDearerAwayFromThePathIsNotSearchedAgain) {
  TestGrid grid(300, 300);
  Potential potential(weighted_costs());
  for (int y = 20; y < 280; ++y) grid(150, y) = kLethalCost;
  const Cell goal{290, 150}, start{10, 150};
  expect_exact(potential, grid, goal, start);
  const Cell middle = potential.trace()[potential.trace().size() / 2];
  const int far = middle.y < 150 ? 285 : 15;  // at the other end of the wall
  for (int x = 100; x < 200; ++x) grid(x, far) = kLethalCost;
  expect_exact(potential, grid, goal, start);
  EXPECT_EQ(potential.expanded(), 0U);
  for (int x = 100; x < 200; ++x) grid(x, middle.y) = kLethalCost;
  expect_exact(potential, grid, goal, start);
  EXPECT_GT(potential.expanded(), 0U);
}

TEST(Potential, OnlyRowsThatHaveChangedAreCompared) {
  TestGrid grid(100, 100);
  std::fill(grid.cost.begin(), grid.cost.end(), std::uint8_t{100});
  std::vector<std::uint64_t> rows(100, 1);
  const CancelFlag cancel{false};
  Potential potential(weighted_costs());
  const auto value = [&](std::uint64_t revision) {
    CostGrid view = grid.view();
    view.revision = revision;
    view.row_revisions = rows.data();
    EXPECT_EQ(potential.search(view, {90, 50}, {10, 50}, cancel), Potential::Result::kFound);
    return potential.at({10, 50});
  };
  const float before = value(1);
  for (int x = 20; x < 80; ++x) grid(x, 50) = kFreeCost;
  EXPECT_EQ(value(2), before);  // so the rows say
  rows[50] = 3;
  EXPECT_LT(value(3), before);
  for (int x = 20; x < 80; ++x) grid(x, 50) = 100;
  EXPECT_EQ(value(2), before);  // a lower revision is another map's: all rows count
}

TEST(Potential, RepairExpandsFewCellsWhenLittleChanges) {
  TestGrid grid(300, 300);
  Potential potential(weighted_costs());
  const CancelFlag cancel{false};
  for (int y = 20; y < 280; ++y) grid(150, y) = kLethalCost;
  ASSERT_EQ(potential.search(grid.view(), {290, 150}, {10, 150}, cancel),
            Potential::Result::kFound);
  const std::size_t first = potential.expanded();
  grid(20, 140) = 100;
  ASSERT_EQ(potential.search(grid.view(), {290, 150}, {11, 150}, cancel),
            Potential::Result::kFound);
  EXPECT_LT(potential.expanded(), first / 10);
}

TEST(Potential, AStraightPathInTheOpenExpandsLittleMoreThanItself) {
  TestGrid grid(1000, 1000);
  Potential potential(weighted_costs());
  const CancelFlag cancel{false};
  ASSERT_EQ(potential.search(grid.view(), {990, 500}, {10, 100}, cancel),
            Potential::Result::kFound);
  EXPECT_LT(potential.expanded(), 1100U);
}

TEST(Potential, APathOfManyTimesTheGridsSidesIsFound) {
  TestGrid grid(401, 401);
  for (int x = 1; x < 400; x += 2) {
    for (int y = 0; y < 401; ++y) grid(x, y) = kLethalCost;
    grid(x, x % 4 == 1 ? 400 : 0) = 252;
  }
  for (int y = 0; y < 401; ++y) {
    for (int x = 0; x < 401; x += 2) grid(x, y) = 252;
  }
  Potential potential(weighted_costs());
  expect_exact(potential, grid, {400, 200}, {0, 200});
}

TEST(Potential, TheOutlineIsBlockedOnDemand) {
  TestGrid grid(20, 20);
  for (int x = 1; x < 19; ++x) grid(x, 10) = kLethalCost;
  const CancelFlag cancel{false};
  Potential closed(weighted_costs(), true);
  EXPECT_EQ(closed.search(grid.view(), {5, 5}, {5, 15}, cancel), Potential::Result::kNoPath);
  Potential open(weighted_costs(), false);
  EXPECT_EQ(open.search(grid.view(), {5, 5}, {5, 15}, cancel), Potential::Result::kFound);
}

TEST(Potential, ACanceledSearchStopsAndCanContinue) {
  TestGrid grid(400, 400);
  for (int y = 0; y < 399; ++y) grid(200, y) = kLethalCost;
  Potential potential(weighted_costs());
  CancelFlag cancel{true};
  EXPECT_EQ(potential.search(grid.view(), {390, 5}, {5, 5}, cancel), Potential::Result::kCanceled);
  expect_exact(potential, grid, {390, 5}, {5, 5});
}

}  // namespace
}  // namespace trident::nav
