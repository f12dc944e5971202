// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "logs/stamp_check.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace trident::slam {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(StampCheck, StampsInOrderAreNoProblem) {
  StampCheck check;
  for (std::int64_t i = 0; i < 100; ++i) check.add(100 * kMillisecond * i);
  check.add(100 * kMillisecond * 99);  // the same again
  EXPECT_EQ(check.text(), "");
}

TEST(StampCheck, CountsThoseThatGoBackOrJumpAndNamesTheFirstAndTheLargest) {
  StampCheck check;
  const std::int64_t stamps_ms[] = {0, 100, 50, 200, 60'200, 60'300, 59'500, 59'600};
  for (const std::int64_t stamp : stamps_ms) check.add(stamp * kMillisecond);
  EXPECT_EQ(check.back(), 2U);
  EXPECT_EQ(check.jumps(), 1U);
  EXPECT_EQ(check.text(),
            "2 stamps go back, first at scan 3, most at scan 7 (0.800 s); 1 stamps jump ahead, "
            "first at scan 5, most at scan 5 (60.000 s): scans are taken in the order of the log");
}

TEST(StampCheck, AbsurdOnesAreCountedAsOthers) {
  StampCheck check;
  for (const std::int64_t stamp : {INT64_MAX, INT64_MIN, INT64_MAX}) check.add(stamp);
  EXPECT_EQ(check.back(), 1U);
  EXPECT_EQ(check.jumps(), 1U);
}

}  // namespace
}  // namespace trident::slam
