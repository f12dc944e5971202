// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/slam_2d_factory.h"

#include <gtest/gtest.h>

namespace trident::slam {
namespace {

TEST(Slam2dRegistry, UnknownNameIsAnError) {
  EXPECT_THROW(builtin_slam_2d().get("no_such_method"), Error);
}

TEST(Slam2dRegistry, EachMethodIsMadeFromItsDefaultsAndNamesItsParameters) {
  const Registry<Slam2dFactory> registry = builtin_slam_2d();
  for (const std::string& name : registry.names()) {
    EXPECT_NE(registry.get(name)(Slam2dSetup()), nullptr) << name;
    EXPECT_FALSE(registry.get(name).parameters.empty()) << name;
  }
}

TEST(Slam2dRegistry, ASetupOfAnySourceGetsTheSameChecks) {
  Slam2dSetup setup;
  setup.source = "parameter";
  setup.path = "/slam";
  setup.set("particles", "0");
  setup.set_default("particles", "3");
  try {
    builtin_slam_2d().get("particle_slam_2d")(setup);
    FAIL() << "0 particles were accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "parameter /slam/particles: 0 is out of range; must be a whole number in [1, "
                 "10000]");
  }
}

TEST(Slam2dRegistry, CapabilitiesAreThoseOfTheClasses) {
  const Registry<Slam2dFactory> registry = builtin_slam_2d();
  EXPECT_TRUE(registry.get("graph_slam_2d").has_sessions);
  EXPECT_FALSE(registry.get("hector_slam_2d").has_sessions);
  EXPECT_TRUE(registry.get("hector_slam_2d").maps_without_odometry);
  EXPECT_FALSE(registry.get("odometry").maps_without_odometry);
}

}  // namespace
}  // namespace trident::slam
