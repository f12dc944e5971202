// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/range_sensor_layer.h"

#include <limits>
#include <string>
#include <vector>

#include "costmap_fixture.h"
#include "trident_base/error.h"

namespace trident::nav {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// 40 x 40 cells of 0.1 m, the sensor at (1.05, 2.05) looking along x.
class RangeSensorLayerTest : public ::testing::Test {
 protected:
  void make(const std::string& yaml = "") {
    layer_ = new_layer<RangeSensorLayer>("{topics: [/sonar]" + yaml + "}");
    layer_->resize(grid_of(40, 40, 0.1));
  }
  std::string read(double range, double min_range = 0.1, double max_range = 2.0, int times = 6) {
    RangeReading reading;
    reading.field_of_view = 0.4;
    reading.min_range = min_range;
    reading.max_range = max_range;
    reading.range = range;
    reading.T_costmap_sensor.p = {1.05, 2.05, 0.3};
    std::string fault;
    for (int i = 0; i < times; ++i) fault = layer_->add_reading(0, reading);
    BlockSet changed(40, 40);
    layer_->update({}, changed);
    return fault;
  }
  int cost(double x, double y, std::uint8_t below = kUnknownCost) {
    const Cell cell = grid_of(40, 40, 0.1).cell(x, y);
    layer_->combine(cell.y, cell.x, cell.x + 1, &below);
    return below;
  }
  std::unique_ptr<RangeSensorLayer> layer_;
};

TEST_F(RangeSensorLayerTest, TheArcIsMarkedAndTheConeBeforeItCleared) {
  make();
  EXPECT_EQ(read(1.0), "");
  EXPECT_EQ(cost(2.05, 2.05), 254);
  EXPECT_EQ(cost(1.55, 2.05), 0);
  EXPECT_EQ(cost(1.55, 2.05, 100), 100);  // free replaces nothing but unknown
  EXPECT_EQ(cost(1.55, 2.55), 255);       // outside of the cone
  EXPECT_EQ(cost(2.35, 2.05), 255);       // behind the arc
}

TEST_F(RangeSensorLayerTest, WhatWasMarkedCanBeClearedAndMarkedAgain) {
  make();
  read(0.5, 0.1, 2.0, 40);
  EXPECT_EQ(cost(1.55, 2.05), 254);
  read(1.2, 0.1, 2.0, 60);
  EXPECT_EQ(cost(1.55, 2.05), 0);
  read(0.5, 0.1, 2.0, 60);
  EXPECT_EQ(cost(1.55, 2.05), 254);
}

TEST_F(RangeSensorLayerTest, LargestReadingsClearOnRequest) {
  make();
  read(0.5);
  read(2.0, 0.1, 2.0, 1);
  EXPECT_EQ(cost(1.55, 2.05), 254);
  make(", clear_on_max_reading: true");
  read(0.5);
  read(2.0, 0.1, 2.0, 1);
  EXPECT_EQ(cost(1.55, 2.05), 0);
  EXPECT_EQ(cost(1.55, 2.55), 255);  // no more than the cone
}

TEST_F(RangeSensorLayerTest, FixedRangeFindersSayYesOrNo) {
  make(", clear_on_max_reading: true");
  EXPECT_EQ(read(-kInfinity, 0.5, 0.5), "");
  EXPECT_EQ(cost(1.55, 2.05), 254);
  EXPECT_EQ(read(kInfinity, 0.5, 0.5, 1), "");
  EXPECT_EQ(cost(1.55, 2.05), 0);
  EXPECT_NE(read(0.3, 0.5, 0.5).find("-infinity (obstacle) and infinity (none)"),
            std::string::npos);
}

TEST_F(RangeSensorLayerTest, ReadingsThatCannotBeAreRefused) {
  make();
  EXPECT_NE(read(3.0).find("outside of [0.1, 2] m"), std::string::npos);
  EXPECT_NE(read(std::nan("")).find("outside of"), std::string::npos);
  EXPECT_NE(read(1.0, 2.0, 1.0).find("min_range <= max_range"), std::string::npos);
  EXPECT_THROW(new_layer<RangeSensorLayer>("{clear_threshold: 0.9}"), Error);
  EXPECT_THROW(new_layer<RangeSensorLayer>("{input_sensor_type: NONE}"), Error);
}

TEST_F(RangeSensorLayerTest, ANarrowConeIsTheTriangle) {
  make(", inflate_cone: 0.0");
  read(1.0);
  EXPECT_EQ(cost(2.05, 2.05), 254);
  EXPECT_EQ(cost(1.55, 2.05), 0);
}

TEST_F(RangeSensorLayerTest, ForgettingAndStaleness) {
  make(", no_readings_timeout: 0.5");
  read(1.0);
  layer_->forget({0, 0, 40, 40}, Layer::Side::kInside);
  EXPECT_EQ(cost(2.05, 2.05), 255);
  EXPECT_TRUE(layer_->stale_sources(0.4).empty());
  ASSERT_EQ(layer_->stale_sources(0.6).size(), 1U);
  EXPECT_EQ(layer_->stale_sources(0.6)[0].topic, "/sonar");
}

}  // namespace
}  // namespace trident::nav
