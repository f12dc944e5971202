// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "sensors/lidar/lidar_spec.h"
#include "test_world.h"

namespace trident::sim {
namespace {

SensorSpec sensor_of(const std::string& ray) {
  const WorldSpec world = load_world_string(
      "<sdf version='1.6'><world name='w'><model name='m'><static>true</static><link name='l'>"
      "<sensor name='laser' type='ray'>" +
          ray + "</sensor></link></model></world></sdf>",
      "test.world", Resources(), [](const std::string&) {});
  return world.models.at(0).links.at(0).sensors.at(0);
}

std::string ray(const std::string& horizontal, const std::string& range,
                const std::string& more = "") {
  return "<ray><scan><horizontal>" + horizontal + "</horizontal></scan><range>" + range +
         "</range>" + more + "</ray>";
}

const char kFan[] = "<samples>360</samples><min_angle>0</min_angle><max_angle>6.28319</max_angle>";
const char kRange[] = "<min>0.12</min><max>3.5</max><resolution>0.015</resolution>";

TEST(LidarSpec, IsReadFromTheSensor) {
  const LidarSpec spec = read_lidar_spec(
      sensor_of(ray(kFan, kRange,
                    "<noise><type>gaussian</type><mean>0.01</mean><stddev>0.02</stddev></noise>")),
      "laser");
  EXPECT_EQ(spec.horizontal.beams, 360);
  EXPECT_EQ(spec.vertical.beams, 1);
  EXPECT_NEAR(spec.horizontal.increment_rad(), 6.28319 / 359, 1e-12);
  EXPECT_DOUBLE_EQ(spec.horizontal.angle_rad(0), 0.0);
  EXPECT_NEAR(spec.horizontal.angle_rad(359), 6.28319, 1e-12);
  EXPECT_DOUBLE_EQ(spec.range_min_m, 0.12);
  EXPECT_DOUBLE_EQ(spec.range_max_m, 3.5);
  EXPECT_DOUBLE_EQ(spec.noise.mean, 0.01);
  EXPECT_DOUBLE_EQ(spec.noise.stddev, 0.02);
}

TEST(LidarSpec, ResolutionMultipliesTheBeams) {
  const std::string fan =
      "<samples>100</samples><resolution>0.5</resolution><min_angle>-1</min_angle>"
      "<max_angle>1</max_angle>";
  EXPECT_EQ(read_lidar_spec(sensor_of(ray(fan, kRange)), "laser").horizontal.beams, 50);
}

struct Refusal {
  std::string ray, message;
};
class RefusedLidar : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedLidar, NamesElementValueAndRange) {
  const SensorSpec sensor = sensor_of(GetParam().ray);
  const std::string error = error_of([&] { read_lidar_spec(sensor, "sensor 'laser'"); });
  EXPECT_TRUE(contains(error, "sensor 'laser'")) << error;
  EXPECT_TRUE(contains(error, GetParam().message)) << error;
}
INSTANTIATE_TEST_SUITE_P(
    All, RefusedLidar,
    testing::Values(
        Refusal{ray("<samples>0</samples><min_angle>0</min_angle><max_angle>1</max_angle>", kRange),
                "<samples> is '0', expected a finite number in [1, 1e+09]"},
        Refusal{
            ray("<samples>9</samples><min_angle>1</min_angle><max_angle>-1</max_angle>", kRange),
            "<max_angle> is '-1', expected at least <min_angle>, 1"},
        Refusal{ray("<samples>1000000000</samples>", kRange),
                "1e+09 x 1 beams are 1e+09 rays, must be at most 2e+07 "
                "(<trident:max_rays> of the sensor)"},
        Refusal{ray("<samples>10000000</samples><resolution>1000</resolution>", kRange),
                "1e+10 x 1 beams are"},
        Refusal{ray("<samples>1000000000</samples>", kRange) +
                    "<trident:max_rays>1000000000</trident:max_rays>",
                "beams would take 186.3 GiB of memory, must be at most "},
        Refusal{ray(kFan, kRange) + "<trident:max_rays>100</trident:max_rays>",
                "360 x 1 beams are 360 rays, must be at most 100"},
        Refusal{ray(kFan, "<min>4</min><max>3</max>"), "<min> is '4', expected less than <max>, 3"},
        Refusal{ray(kFan, "<min>-1</min><max>3</max>"), "<min> is '-1'"},
        Refusal{ray(kFan, kRange, "<noise><type>gaussian</type><stddev>-1</stddev></noise>"),
                "<stddev> is '-1'"}));

TEST(LidarSpec, ASensorOfAnotherTypeIsRefused) {
  SensorSpec sensor;
  EXPECT_TRUE(contains(error_of([&] { read_lidar_spec(sensor, "s"); }), "<ray> is missing"));
}

}  // namespace
}  // namespace trident::sim
