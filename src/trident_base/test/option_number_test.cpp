// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/option_number.h"

#include <gtest/gtest.h>

#include "trident_base/error.h"

namespace trident {
namespace {

std::string refusal(const std::string& text, double lo, double hi) {
  try {
    option_number("--n", text, lo, hi);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(OptionNumber, EndsOfTheRangeAreLegal) {
  EXPECT_EQ(option_number("--n", "1", 1.0, 1000.0), 1.0);
  EXPECT_EQ(option_number("--n", "1e3", 1.0, 1000.0), 1000.0);
  EXPECT_EQ(option_number("--n", "2.5", 1.0, 1000.0), 2.5);
  EXPECT_EQ(option_number("--n", "-0.25", -0.25, 0.0), -0.25);
}

TEST(OptionNumber, WhatIsBeyondTheRangeIsRefused) {
  for (const char* text : {"0.999", "1000.001", "-1", "inf", "-inf", "1e999"}) {
    EXPECT_NE(refusal(text, 1.0, 1000.0), "") << text;
  }
}

TEST(OptionNumber, WhatIsNoNumberIsRefused) {
  for (const char* text : {"", " ", "many", "5x", "5 ", "5 6", "1,5", "--out", "nan"}) {
    EXPECT_NE(refusal(text, 1.0, 1000.0), "") << text;
  }
}

TEST(OptionNumber, TheErrorNamesOptionTextAndRange) {
  const std::string legal = "must be a number in [1, 1000]";
  EXPECT_EQ(refusal("5x", 1.0, 1000.0), "option --n is '5x', " + legal);
  EXPECT_EQ(refusal("0", 1.0, 1000.0), "option --n is '0', " + legal);
}

TEST(OptionCount, OnlyWholeNumbersWithinTheRangeAreTaken) {
  EXPECT_EQ(option_count("--n", "1", 1, 1000), 1);
  EXPECT_EQ(option_count("--n", "1e3", 1, 1000), 1000);
  EXPECT_EQ(option_count("--n", "-3.0", -3, 0), -3);
  EXPECT_EQ(option_count("--n", "9007199254740991", 0, 9007199254740991), 9007199254740991);
  for (const char* text : {"0", "1001", "2.5", "5x", "", "nan", "inf", "1e999"}) {
    try {
      option_count("--n", text, 1, 1000);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()),
                std::string("option --n is '") + text + "', must be a whole number in [1, 1000]");
    }
  }
}

}  // namespace
}  // namespace trident
