// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/block_set.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "../core/test_random.h"

namespace trident::nav {
namespace {

TEST(BlockSetTest, SpansCoverWhatWasInsertedAndNoOtherBlock) {
  TestRandom random(1);
  BlockSet set(2500, 9), other(2500, 9);
  std::set<std::pair<int, int>> expected;  // row, block
  for (int round = 0; round < 30; ++round) {
    for (int k = 0; k < 20; ++k) {
      const int y = random.below(9), x0 = random.below(2700) - 100, x1 = x0 + random.below(200);
      set.insert_span(y, x0, x1);
      for (int x = std::max(x0, 0); x < std::min(x1, 2500); ++x) expected.insert({y, x / 16});
    }
    other.clear();
    const int x = random.below(2500), y = random.below(9);
    other.insert(x, y);
    set.insert(other);
    expected.insert({y, x / 16});
    std::set<std::pair<int, int>> found;
    int runs = 0;
    set.for_each_span([&](int row, int x0, int x1) {
      EXPECT_EQ(x0 % 16, 0);
      EXPECT_TRUE(x1 % 16 == 0 || x1 == 2500);
      for (int block = x0 / 16; block * 16 < x1; ++block) found.insert({row, block});
      ++runs;
    });
    EXPECT_EQ(found, expected);
    EXPECT_EQ(set.count(), expected.size());
    EXPECT_GT(runs, 0);
    if (round % 5 == 4) {
      set.clear();
      expected.clear();
      EXPECT_TRUE(set.empty());
      EXPECT_EQ(set.count(), 0U);
    }
  }
}

TEST(BlockSetTest, Bounds) {
  BlockSet set(100, 50);
  EXPECT_TRUE(set.bounds().empty());
  set.insert(40, 7);
  set.insert(99, 30);
  const CellBox box = set.bounds();
  EXPECT_EQ(box.x0, 32);
  EXPECT_EQ(box.x1, 100);
  EXPECT_EQ(box.y0, 7);
  EXPECT_EQ(box.y1, 31);
  set.erase(99, 30);
  EXPECT_FALSE(set.contains(99, 30));
  set.insert_all();
  EXPECT_EQ(set.count(), 350U);
}

}  // namespace
}  // namespace trident::nav
