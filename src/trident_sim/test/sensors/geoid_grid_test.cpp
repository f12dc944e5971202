// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sensors/gnss/geoid_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

template <class Number>
void append(std::string& bytes, Number value) {
  std::array<char, sizeof(Number)> big{};
  std::memcpy(big.data(), &value, big.size());
  std::reverse(big.begin(), big.end());
  bytes.append(big.data(), big.size());
}

std::string grid(double south, double west, double step, int rows, int columns) {
  std::string bytes;
  for (const double number : {south, west, step, step}) append(bytes, number);
  append(bytes, std::int32_t{rows});
  append(bytes, std::int32_t{columns});
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      append(bytes, static_cast<float>(100 * row + column));
    }
  }
  return bytes;
}

class GeoidGrid : public testing::Test {
 protected:
  std::string write(const std::string& bytes) const {
    const std::string file = folder_.path() + "/test.gtx";
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }
  ScratchFolder folder_;
};

TEST_F(GeoidGrid, IsLinearBetweenItsNodes) {
  const std::string file = write(grid(10.0, 20.0, 0.5, 3, 4));
  EXPECT_EQ(geoid_height_m(file, 10.0, 20.0), 0.0);
  EXPECT_EQ(geoid_height_m(file, 11.0, 21.5), 203.0);
  EXPECT_DOUBLE_EQ(*geoid_height_m(file, 10.25, 20.125), 50.25);
  EXPECT_DOUBLE_EQ(*geoid_height_m(file, 10.25, 20.125 - 360.0), 50.25);
  EXPECT_EQ(geoid_height_m(file, 9.9, 20.0), std::nullopt);
  EXPECT_EQ(geoid_height_m(file, 10.0, 21.6), std::nullopt);
}

TEST_F(GeoidGrid, GoesRoundTheEarth) {
  const std::string file = write(grid(-90.0, -180.0, 90.0, 3, 4));
  EXPECT_DOUBLE_EQ(*geoid_height_m(file, 0.0, 90.0), 103.0);
  EXPECT_DOUBLE_EQ(*geoid_height_m(file, 0.0, 135.0), 101.5) << "halfway to that at -180";
  EXPECT_DOUBLE_EQ(*geoid_height_m(file, 0.0, 180.0), 100.0);
  EXPECT_DOUBLE_EQ(*geoid_height_m(file, 90.0, 0.0), 202.0);
}

TEST_F(GeoidGrid, WhatIsNoGridIsRefused) {
  const auto refusal = [](const std::string& file) {
    return error_of([&] { geoid_height_m(file, 10.0, 20.0); });
  };
  EXPECT_TRUE(contains(refusal("/nowhere/a.gtx"), "geoid '/nowhere/a.gtx' cannot be read"));
  EXPECT_TRUE(contains(refusal(write("short")), "cannot be read"));
  EXPECT_TRUE(contains(refusal(write(grid(10.0, 20.0, 0.5, 3, 4).substr(0, 50))), "cut off"));
  EXPECT_TRUE(contains(refusal(write(grid(10.0, 20.0, -0.5, 3, 4))), "not a GTX file"));
}

TEST(Egm96, AgreesWithTheHeightsThatItsAuthorsPublish) {
  const std::string file = find_egm96_grid();
  if (file.empty()) GTEST_SKIP() << "proj-data is not installed";
  // Check values of NGA's program F477 for EGM96 (OUTPUT.DAT) [degrees], [m].
  struct Place {
    double latitude, longitude, height;
  };
  for (const Place& place :
       {Place{38.6281550, 269.7791550, -31.628}, Place{-14.6212170, 305.0211140, -2.969},
        Place{46.8743190, 102.4487290, -43.575}, Place{-23.6174460, 133.8747120, 15.871},
        Place{38.6254730, 359.9995000, 50.066}, Place{-0.4667440, 0.0023000, 17.329}}) {
    const auto height = geoid_height_m(file, place.latitude, place.longitude);
    ASSERT_TRUE(height.has_value());
    EXPECT_NEAR(*height, place.height, 0.1) << place.latitude << " " << place.longitude;
  }
}

}  // namespace
}  // namespace trident::sim
