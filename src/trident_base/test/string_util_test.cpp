// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/string_util.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trident {
namespace {

TEST(StringUtil, StartsWithAndEndsWith) {
  EXPECT_TRUE(starts_with("rotor_0", "rotor"));
  EXPECT_TRUE(ends_with("rotor_0", "_0"));
  for (const char* part : {"", "rotor_0"}) {
    EXPECT_TRUE(starts_with("rotor_0", part)) << part;
    EXPECT_TRUE(ends_with("rotor_0", part)) << part;
  }
  for (const char* other : {"otor", "rotor_00", "x_rotor_0"}) {
    EXPECT_FALSE(starts_with("rotor_0", other)) << other;
    EXPECT_FALSE(ends_with("rotor_0", other)) << other;
  }
  EXPECT_FALSE(starts_with("", "a"));
  EXPECT_FALSE(ends_with("", "a"));
}

TEST(StringUtil, Join) {
  EXPECT_EQ(join({}), "");
  EXPECT_EQ(join({"a"}), "a");
  EXPECT_EQ(join({"a", "a", "b"}, "/"), "a/a/b");
}

TEST(StringUtil, NumberTextIsShortAndExact) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(-2.0), "-2");
  EXPECT_EQ(std::stod(number_text(1.0 / 3.0)), 1.0 / 3.0);
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(StringUtil, ANumberIsTheWholeText) {
  EXPECT_EQ(number_from_text("0.1"), 0.1);
  EXPECT_EQ(number_from_text(" -2e3"), -2000.0);
  EXPECT_EQ(number_from_text("inf"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(number_from_text("nan").value()));
  for (const char* text : {"", " ", "x", "5x", "5 ", "5 6", "1,5", "1e999", "1e-999"}) {
    EXPECT_EQ(number_from_text(text), std::nullopt) << text;
  }
}

TEST(StringUtil, EditDistanceCountsSlips) {
  EXPECT_EQ(edit_distance("mass", "mass"), 0u);
  EXPECT_EQ(edit_distance("Mass", "mAss"), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("froce", "force"), 1u);  // neighbours swapped
}

TEST(StringUtil, ClosestMatchIsTheLikelyIntention) {
  const std::vector<std::string> known{"force_constant", "mass", "max_velocity"};
  EXPECT_EQ(closest_match("forse_constant", known), "force_constant");
  EXPECT_EQ(closest_match("mas", known), "mass");
  EXPECT_EQ(closest_match("force", known), "force_constant");
  EXPECT_EQ(closest_match("MASS", known), "mass");
  EXPECT_EQ(closest_match("wind", known), "");
  EXPECT_EQ(closest_match("x", {}), "");
}

}  // namespace
}  // namespace trident
