// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/parameter_names.h"

#include <gtest/gtest.h>

#include "trident_slam/hector_slam_2d.h"

namespace trident::slam {
namespace {

TEST(ParameterNames, AreThoseOfTheStruct) {
  const ParameterNames names = field_names<HectorSlamParams>();
  EXPECT_EQ(names.front(), "map_resolution");
}

TEST(ParameterNames, WhatDoesNothingIsNamed) {
  const UnusedParameters unused =
      unused_parameters({"resolution", "stack_size_to_use", "resolutoin", "zzz"},
                        {"resolution", "map_frame"}, {"stack_size_to_use"});
  EXPECT_EQ(unused.without_effect, ParameterNames{"stack_size_to_use"});
  EXPECT_EQ(unused.unknown, (ParameterNames{"resolutoin (did you mean resolution?)", "zzz"}));
}

}  // namespace
}  // namespace trident::slam
