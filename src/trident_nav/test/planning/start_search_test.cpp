// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/potential/start_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planning/reference_search.h"
#include "trident_base/random_stream.h"

namespace trident::nav {
namespace {

using testing::kRunning;
using testing::reference_potential;
using testing::TestGrid;
using Result = StartSearch::Result;

constexpr int kWidth = 150, kHeight = 110;

StepCosts weighted_costs() {
  StepCosts costs;
  for (int c = 0; c <= 252; ++c) costs.step[c] = 50.0F + 0.8F * static_cast<float>(c);
  return costs;
}

/// A grid with patches of random costs, whose potential is kept while some of them become dearer.
class LedSearch : public ::testing::Test {
 protected:
  int number(int below) { return static_cast<int>(random_.uniform(next_++, 0) * below); }
  void patch(int side, std::uint8_t cost, bool only_dearer) {
    const int x0 = number(kWidth), y0 = number(kHeight);
    for (int y = y0; y < std::min(kHeight, y0 + side); ++y) {
      for (int x = x0; x < std::min(kWidth, x0 + side); ++x) {
        if (!only_dearer || grid_(x, y) < cost) grid_(x, y) = cost;
      }
    }
  }
  void draw_patches() {
    for (int k = 0; k < 60; ++k)
      patch(1 + number(9), static_cast<std::uint8_t>(number(253)), false);
    for (int k = 0; k < 60; ++k) patch(1 + number(5), kLethalCost, false);
  }
  void raise_patches(int count) {
    for (int k = 0; k < count; ++k) {
      patch(1 + number(8), static_cast<std::uint8_t>(100 + number(155)), true);
    }
  }
  Result search(Cell start, std::uint32_t bound = StartSearch::Limits{}.bound) {
    potential_.search(grid_.view(), goal_, start, kRunning, Potential::Costs::kKnown);
    return search_.search(grid_.view(), potential_, {bound, 1'000'000}, kRunning);
  }
  double cost_of(const std::vector<Cell>& cells) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
      const int dx = cells[i + 1].x - cells[i].x, dy = cells[i + 1].y - cells[i].y;
      EXPECT_LE(std::max(std::abs(dx), std::abs(dy)), 1);
      EXPECT_LT(grid_(cells[i].x + dx, cells[i].y), kInscribedCost);
      EXPECT_LT(grid_(cells[i].x, cells[i].y + dy), kInscribedCost);
      sum += weighted_costs().step[grid_(cells[i].x, cells[i].y)] * std::hypot(dx, dy);
    }
    return sum;
  }
  /// What is found costs as much as Dijkstra's path, and bounds about that are distinguished.
  void expect_least(Cell start) {
    const CostGrid view = grid_.view();
    const double least =
        reference_potential(view, weighted_costs(), goal_)[view.geometry.index(start)];
    const Result result = search(start);
    if (std::isinf(least)) {
      EXPECT_EQ(result, Result::kNoPath);
      return;
    }
    ASSERT_EQ(result, Result::kFound);
    EXPECT_NEAR(search_.cost() / potential_.scale(), least, 5e-5 * least);
    const std::vector<Cell> cells = search_.path();
    EXPECT_NEAR(cost_of(cells), least, 5e-5 * least);
    EXPECT_TRUE(cells.front() == start && cells.back() == goal_);
    const std::uint32_t cost = search_.cost();
    EXPECT_EQ(search(start, cost), Result::kBound);
    EXPECT_EQ(search(start, cost + 1), Result::kFound);
    EXPECT_EQ(search_.cost(), cost);
  }

  RandomStream random_{5, "patches"};
  std::uint64_t next_ = 0;
  TestGrid grid_{kWidth, kHeight};
  const Cell goal_{140, 100};
  Potential potential_{weighted_costs()};
  StartSearch search_{false};
};

TEST_F(LedSearch, CostsAsMuchAsDijkstrasPathWhateverBecameDearer) {
  for (int round = 0; round < 25; ++round) {
    std::fill(grid_.cost.begin(), grid_.cost.end(), kFreeCost);
    draw_patches();
    potential_.clear();
    for (int step = 0; step < 4; ++step) {
      const Cell start{number(60), number(60)};
      grid_(start.x, start.y) = grid_(goal_.x, goal_.y) = kFreeCost;
      if (step == 0) {
        const auto first =
            potential_.search(grid_.view(), goal_, start, kRunning, Potential::Costs::kKnown);
        if (first != Potential::Result::kFound) break;
      }
      raise_patches(5 * step);
      grid_(start.x, start.y) = grid_(goal_.x, goal_.y) = kFreeCost;
      const auto known =
          potential_.search(grid_.view(), goal_, start, kRunning, Potential::Costs::kKnown);
      if (known != Potential::Result::kFound) break;
      expect_least(start);
    }
  }
}

TEST_F(LedSearch, StaysNearWhatBecameDearer) {
  const Cell start{10, 100};
  ASSERT_EQ(search(start), Result::kFound);
  EXPECT_EQ(search_.expanded(), 0U);
  for (int y = 95; y < 106; ++y) grid_(75, y) = kLethalCost;
  expect_least(start);
  EXPECT_GT(search_.expanded(), 0U);
  EXPECT_LT(search_.expanded(), 2000U);
}

TEST_F(LedSearch, DistinguishesACutOffStartACanceledSearchAndOneThatIsTooLong) {
  const Cell start{10, 10};
  ASSERT_EQ(search(start), Result::kFound);
  for (int y = 0; y < kHeight; ++y) grid_(75, y) = kLethalCost;
  EXPECT_EQ(search(start), Result::kNoPath);
  EXPECT_EQ(search_.search(grid_.view(), potential_, {StartSearch::Limits{}.bound, 50}, kRunning),
            Result::kTooLong);
  const CancelFlag canceled{true};
  EXPECT_EQ(
      search_.search(grid_.view(), potential_, {StartSearch::Limits{}.bound, 1'000'000}, canceled),
      Result::kCanceled);
}

}  // namespace
}  // namespace trident::nav
