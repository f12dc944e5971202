// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/distance_tracker.h"

#include <vector>

#include "costmap_fixture.h"

namespace trident::nav {
namespace {

/// Notes what each call handed out.
class Collector : public DistanceSink {
 public:
  void take(const DistanceSpan& span) override { spans += span.x1 - span.x0; }
  int spans = 0;
};

class DistanceTrackerTest : public ::testing::TestWithParam<double> {};

void expect_exact(const DistanceTracker& tracker, const std::vector<std::uint8_t>& cost,
                  const GridGeometry& grid, double cut) {
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const int square = nearest_square(cost, grid, {x, y});
      const double exact = square < 0 ? cut : std::min(cut, std::sqrt(square) * grid.resolution);
      ASSERT_FLOAT_EQ(tracker.distance_m()[grid.index({x, y})], static_cast<float>(exact))
          << x << ' ' << y;
    }
  }
}

TEST_P(DistanceTrackerTest, AfterAnyChangesDistancesAreThoseOfAllSeeds) {
  const GridGeometry grid = grid_of(37, 26, 0.5);
  const double cut = GetParam();
  DistanceTracker tracker(cut);
  tracker.resize(grid);
  std::vector<std::uint8_t> cost(grid.size(), kFreeCost);
  TestRandom random(7);
  Collector sink;
  for (int round = 0; round < 30; ++round) {
    BlockSet changed(grid.width, grid.height);
    if (round == 0) changed.insert_all();
    // Rounds with many changes compute all columns, the others those that change.
    const int changes = round % 7 == 3 ? 200 : 1 + round % 5;
    for (int k = 0; k < changes; ++k) {
      const Cell cell{static_cast<int>(random.uniform() * grid.width),
                      static_cast<int>(random.uniform() * grid.height)};
      const bool is_set = random.uniform() < (round % 3 == 0 ? 0.8 : 0.2);
      cost[grid.index(cell)] = is_set ? kLethalCost : (k % 2 == 0 ? kUnknownCost : kInscribedCost);
      changed.insert(cell.x, cell.y);
    }
    tracker.update(cost.data(), changed, sink);
    expect_exact(tracker, cost, grid, cut);
  }
}

INSTANTIATE_TEST_SUITE_P(Cuts, DistanceTrackerTest, ::testing::Values(0.5, 1.7, 5.5, 12.0, 100.0));

TEST(DistanceTrackerTest, OneSeedTouchesNoMoreThanItsSurroundings) {
  const GridGeometry grid = grid_of(1000, 1000, 0.05);
  DistanceTracker tracker(0.5);
  tracker.resize(grid);
  std::vector<std::uint8_t> cost(grid.size(), kFreeCost);
  Collector sink;
  BlockSet changed(grid.width, grid.height);
  changed.insert_all();
  tracker.update(cost.data(), changed, sink);
  EXPECT_EQ(sink.spans, 1000 * 1000);

  sink.spans = 0;
  changed.clear();
  changed.insert(500, 500);
  cost[grid.index({500, 500})] = kLethalCost;
  tracker.update(cost.data(), changed, sink);
  EXPECT_GE(sink.spans, 21 * 21);
  EXPECT_LE(sink.spans, 21 * 48);
}

TEST(DistanceTrackerTest, UnknownCellsAreSeedsOnRequest) {
  const GridGeometry grid = grid_of(3, 1);
  const std::vector<std::uint8_t> cost{kUnknownCost, kFreeCost, kFreeCost};
  BlockSet all(3, 1);
  all.insert_all();
  Collector sink;
  DistanceTracker lethal(9.0), both(9.0, DistanceTracker::Seeds::kLethalOrUnknown);
  lethal.resize(grid);
  both.resize(grid);
  lethal.update(cost.data(), all, sink);
  both.update(cost.data(), all, sink);
  EXPECT_FLOAT_EQ(lethal.distance_m()[1], 9.0F);
  EXPECT_FLOAT_EQ(both.distance_m()[1], 1.0F);
}

TEST(DistanceTrackerTest, TheCutIsAtMost254Cells) {
  DistanceTracker tracker(1000.0);
  tracker.resize(grid_of(4, 4, 0.5));
  EXPECT_FLOAT_EQ(tracker.max_distance_m(), 127.0F);
}

}  // namespace
}  // namespace trident::nav
