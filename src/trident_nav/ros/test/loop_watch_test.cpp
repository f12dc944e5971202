// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/loop_watch.h"

#include <gtest/gtest.h>

namespace trident::nav {
namespace {

/// One period that begins at a time and spends it on two steps.
void run(LoopWatch& watch, double now_s, double map_s, double command_s) {
  watch.begin(now_s, now_s, 0.05);
  watch.note("The costmap", now_s + map_s);
  watch.note("The command", now_s + map_s + command_s);
}

TEST(LoopWatch, SaysNothingOfPeriodsThatAreALittleLong) {
  LoopWatch watch;
  for (const double t : {0.0, 0.05, 0.109, 0.159}) run(watch, t, 0.01, 0.02);
  EXPECT_EQ(watch.take_text(0.2), "");
  EXPECT_EQ(watch.missed(), 0);
}

TEST(LoopWatch, NamesTheStepThatTookLongestInTheLongestPeriod) {
  LoopWatch watch;
  run(watch, 0.0, 0.01, 0.06);
  run(watch, 0.07, 0.09, 0.02);
  run(watch, 0.18, 0.01, 0.01);
  const std::string text = watch.take_text(0.18);
  EXPECT_NE(text.find("missed 2 of its periods of 0.050 s"), std::string::npos) << text;
  EXPECT_NE(text.find("the longest was 0.110 s. The costmap took longest in it, 0.090 s."),
            std::string::npos)
      << text;
  EXPECT_EQ(watch.take_text(0.18), "");
  EXPECT_EQ(watch.missed(), 2);
}

TEST(LoopWatch, SaysWhenNoStepIsToBlame) {
  LoopWatch watch;
  run(watch, 0.0, 0.01, 0.002);
  run(watch, 0.2, 0.01, 0.002);
  const std::string text = watch.take_text(0.2);
  EXPECT_NE(text.find("the processor was elsewhere"), std::string::npos) << text;
}

TEST(LoopWatch, LogsOncePerSecondAndKeepsCounting) {
  LoopWatch watch;
  int texts = 0;
  for (int i = 0; i < 20; ++i) {
    run(watch, 0.1 * i, 0.08, 0.01);
    texts += watch.take_text(0.1 * i).empty() ? 0 : 1;
  }
  EXPECT_EQ(watch.missed(), 19);
  EXPECT_EQ(texts, 2);
}

TEST(LoopWatch, APauseIsNoPeriod) {
  LoopWatch watch;
  run(watch, 0.0, 0.01, 0.01);
  watch.pause();
  run(watch, 10.0, 0.01, 0.01);
  EXPECT_EQ(watch.missed(), 0);
}

}  // namespace
}  // namespace trident::nav
