// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/slam_2d.h"

#include <gtest/gtest.h>

namespace trident::slam {
namespace {

TEST(Slam2dRegistry, UnknownNameIsAnError) {
  Registry<Slam2dFactory> registry("SLAM method");
  register_builtin_slam_2d(registry);
  EXPECT_THROW(registry.get("no_such_method"), Error);
}

}  // namespace
}  // namespace trident::slam
