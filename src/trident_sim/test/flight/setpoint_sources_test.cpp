// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "test_world.h"
#include "trident_sim/lockstep.h"

namespace trident::sim {
namespace {

SimTime ms(std::int64_t milliseconds) { return {milliseconds * 1'000'000}; }

SetpointSources with_source(SimTime end = {0}, SimTime now = {0}) {
  SetpointSources sources;
  sources.enroll("leader", {"UAV1", "UAV2"}, ms(100), end, now);
  return sources;
}

TEST(SetpointSources, NobodyBlocksAnEmptyWorld) {
  SetpointSources sources;
  EXPECT_EQ(sources.blocking(ms(500)), nullptr);
  EXPECT_EQ(sources.end(), ms(0));
}

TEST(SetpointSources, BlocksUntilEveryVehicleHasItsSetpoint) {
  SetpointSources sources = with_source();
  ASSERT_NE(sources.blocking(ms(100)), nullptr);
  EXPECT_EQ(*sources.blocking(ms(100)), "leader");
  sources.on_setpoint("UAV1", ms(100));
  EXPECT_EQ(sources.missing("leader", ms(100)), std::vector<std::string>{"UAV2"});
  EXPECT_NE(sources.blocking(ms(100)), nullptr);
  sources.on_setpoint("UAV2", ms(100));
  EXPECT_EQ(sources.blocking(ms(100)), nullptr);
}

TEST(SetpointSources, BlocksAtItsPeriodOnly) {
  SetpointSources sources = with_source();
  EXPECT_EQ(sources.blocking(ms(99)), nullptr);
  EXPECT_NE(sources.blocking(ms(100)), nullptr);
  for (const char* name : {"UAV1", "UAV2"}) sources.on_setpoint(name, ms(300));
  EXPECT_EQ(sources.blocking(ms(399)), nullptr);
  EXPECT_NE(sources.blocking(ms(400)), nullptr);
}

TEST(SetpointSources, AnOldSetpointThatReplacesTheLaterOnesUncovers) {
  SetpointSources sources = with_source();
  for (const char* name : {"UAV1", "UAV2"}) sources.on_setpoint(name, ms(800));
  EXPECT_EQ(sources.blocking(ms(700)), nullptr);
  sources.on_setpoint("UAV2", ms(500), true);
  EXPECT_EQ(sources.blocking(ms(599)), nullptr);
  ASSERT_NE(sources.blocking(ms(600)), nullptr);
  EXPECT_EQ(sources.missing("leader", ms(600)), std::vector<std::string>{"UAV2"});
}

TEST(SetpointSources, WhatWasReplacedIsReportedOnceAndForgottenOnce) {
  SetpointSources sources = with_source();
  EXPECT_FALSE(sources.on_setpoint("UAV1", ms(800), true));
  EXPECT_FALSE(sources.forget_replacements());
  EXPECT_TRUE(sources.on_setpoint("UAV1", ms(500), true)) << "taken from a source";
  EXPECT_FALSE(sources.on_setpoint("UAV9", ms(500), true)) << "nobody feeds it";
  EXPECT_TRUE(sources.forget_replacements());
  EXPECT_FALSE(sources.forget_replacements());
  EXPECT_TRUE(sources.feeds("UAV2"));
  EXPECT_FALSE(sources.feeds("UAV9"));
}

TEST(SetpointSources, WaitsBeyondTheEndOfASourceThatSaysSo) {
  SetpointSources sources;
  sources.enroll("leader", {"UAV1"}, ms(100), ms(1000), {0});
  sources.enroll("followers", {"UAV2"}, ms(100), ms(500), {0}, true);
  sources.on_setpoint("UAV1", ms(600));
  sources.on_setpoint("UAV2", ms(500));
  EXPECT_EQ(sources.end(), ms(1000)) << "the run ends with the last source";
  ASSERT_NE(sources.blocking(ms(600)), nullptr);
  EXPECT_EQ(*sources.blocking(ms(600)), "followers");
  sources.enroll("followers", {"UAV2"}, ms(100), ms(500), {0});
  EXPECT_EQ(sources.blocking(ms(600)), nullptr) << "it does not say so any more";
}

TEST(SetpointSources, TheEndOfASourceIsTakenBack) {
  SetpointSources sources = with_source(ms(500));
  EXPECT_EQ(sources.end(), ms(500));
  sources.enroll("leader", {"UAV1", "UAV2"}, ms(100), {0}, ms(400));
  EXPECT_EQ(sources.end(), ms(0));
  EXPECT_NE(sources.blocking(ms(600)), nullptr);
}

TEST(SetpointSources, AnOldSetpointDoesNotUncover) {
  SetpointSources sources = with_source();
  for (const char* name : {"UAV1", "UAV2"}) sources.on_setpoint(name, ms(300));
  sources.on_setpoint("UAV1", ms(100));
  EXPECT_EQ(sources.blocking(ms(300)), nullptr);
}

TEST(SetpointSources, StartsAtTheNextMultipleOfItsPeriodAfterNow) {
  SetpointSources sources;
  EXPECT_EQ(sources.enroll("leader", {"UAV1"}, ms(100), {0}, ms(130)), ms(200));
  EXPECT_EQ(sources.blocking(ms(199)), nullptr);
  EXPECT_NE(sources.blocking(ms(200)), nullptr);
  EXPECT_EQ(sources.enroll("other", {"UAV2"}, ms(100), {0}, ms(200)), ms(300));
}

TEST(SetpointSources, DoesNotBlockFromItsEndOn) {
  SetpointSources sources = with_source(ms(200));
  for (const char* name : {"UAV1", "UAV2"}) sources.on_setpoint(name, ms(100));
  EXPECT_EQ(sources.blocking(ms(199)), nullptr);
  EXPECT_EQ(sources.blocking(ms(200)), nullptr);
  EXPECT_EQ(sources.end(), ms(200));
}

TEST(SetpointSources, TheEndIsTheLatestAndUnknownWhileOneIsUnknown) {
  SetpointSources sources = with_source(ms(200));
  sources.enroll("other", {"UAV3"}, ms(100), {0}, ms(0));
  EXPECT_EQ(sources.end(), ms(0));
  sources.enroll("other", {"UAV3"}, ms(100), ms(500), ms(0));
  EXPECT_EQ(sources.end(), ms(500));
}

TEST(SetpointSources, EnrollingAgainOnlyMovesTheEnd) {
  SetpointSources sources = with_source({0}, ms(130));
  EXPECT_EQ(sources.enroll("leader", {"UAV1", "UAV2"}, ms(100), ms(900), ms(550)), ms(200));
  EXPECT_EQ(sources.end(), ms(900));
}

TEST(SetpointSources, SourcesBlockInNameOrder) {
  SetpointSources sources = with_source();
  sources.enroll("alpha", {"UAV3"}, ms(50), {0}, ms(0));
  EXPECT_EQ(*sources.blocking(ms(100)), "alpha");
  sources.on_setpoint("UAV3", ms(100));
  EXPECT_EQ(*sources.blocking(ms(100)), "leader");
}

TEST(SetpointSources, AReleasedSourceDoesNotBlock) {
  SetpointSources sources = with_source();
  sources.release("leader");
  EXPECT_EQ(sources.blocking(ms(100)), nullptr);
}

TEST(SetpointSources, ClearForgetsWhatWasCovered) {
  SetpointSources sources = with_source();
  for (const char* name : {"UAV1", "UAV2"}) sources.on_setpoint(name, ms(300));
  sources.clear();
  EXPECT_TRUE(sources.all().empty());
  sources.enroll("leader", {"UAV1", "UAV2"}, ms(100), {0}, ms(0));
  EXPECT_NE(sources.blocking(ms(100)), nullptr);
}

TEST(SetpointSources, RefusesNonsense) {
  SetpointSources sources;
  EXPECT_TRUE(
      contains(error_of([&] { sources.enroll("n", {"UAV1"}, ms(0), {0}, {0}); }), "period"));
  EXPECT_TRUE(
      contains(error_of([&] { sources.enroll("n", {}, ms(100), {0}, {0}); }), "no vehicles"));
}

}  // namespace
}  // namespace trident::sim
