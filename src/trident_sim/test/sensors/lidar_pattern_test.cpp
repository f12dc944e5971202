// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sensors/lidar/lidar_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "models.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

LidarSpec spec_of(int columns, double max_rad, int rings, double highest_rad) {
  LidarSpec spec;
  spec.horizontal = {columns, 0.0, max_rad};
  spec.vertical = {rings, -highest_rad, highest_rad};
  spec.range_max_m = 100.0;
  return spec;
}

std::unique_ptr<LidarPattern> pattern_of(const LidarSpec& spec, const ParamList& params,
                                         bool is_rolling = true, double rate_hz = 10.0) {
  const ParamNode node = make_plugin("p", "f", params).params;
  return make_pattern({spec, rate_hz, is_rolling}, PluginParams(node, "the owner"));
}

std::vector<Eigen::Vector3d> directions(const LidarPattern& pattern, std::uint64_t scan,
                                        std::size_t column) {
  std::vector<Eigen::Vector3d> result(pattern.beams().size());
  pattern.aim(scan, column, result.data());
  return result;
}

TEST(RingPattern, BeamsPointWhereTheSensorHasTurnedToAtTheirTime) {
  const double column_s = 55.296e-6, spin = 2.0 * kPi * 10.0;
  const auto pattern = pattern_of(spec_of(1808, 1807 * column_s * spin, 16, deg_to_rad(15.0)),
                                  {{"beamPeriod", "2.304e-6"}});
  EXPECT_NEAR(pattern->column_period_s(), column_s, 1e-12);
  for (const std::size_t column : {std::size_t{0}, std::size_t{777}, std::size_t{1807}}) {
    const auto beams = directions(*pattern, 3, column);
    for (std::size_t ring = 0; ring < 16; ++ring) {
      const double time_s = static_cast<double>(column) * column_s + pattern->beams()[ring].time_s;
      EXPECT_NEAR(pattern->beams()[ring].time_s, static_cast<double>(ring) * 2.304e-6, 1e-15);
      EXPECT_NEAR(beams[ring].norm(), 1.0, 1e-12);
      EXPECT_NEAR(std::asin(beams[ring].z()), deg_to_rad(2.0 * static_cast<double>(ring) - 15.0),
                  1e-12);
      EXPECT_NEAR(wrap_to_pi(std::atan2(beams[ring].y(), beams[ring].x()) - spin * time_s), 0.0,
                  1e-9);
    }
  }
}

TEST(RingPattern, FiringOrderGivesTimesToRings) {
  const auto pattern =
      pattern_of(spec_of(10, 5.0, 4, 0.2), {{"beamPeriod", "1e-6"}, {"firingOrder", "0 2 1 3"}});
  EXPECT_EQ(pattern->firing_order(), (std::vector<std::size_t>{0, 2, 1, 3}));
  EXPECT_EQ(pattern->beams()[1].time_s, 2e-6);
  EXPECT_EQ(pattern->beams()[2].time_s, 1e-6);
}

TEST(RingPattern, ElevationsCanBeGiven) {
  const auto pattern = pattern_of(spec_of(10, 5.0, 3, 0.2), {{"elevations", "-0.4 0.0 0.1"}});
  const auto beams = directions(*pattern, 0, 0);
  EXPECT_NEAR(std::asin(beams[0].z()), -0.4, 1e-12);
  EXPECT_NEAR(std::asin(beams[2].z()), 0.1, 1e-12);
}

TEST(RingPattern, OfASnapshotHasNoTimes) {
  const auto pattern =
      pattern_of(spec_of(10, 5.0, 4, 0.2), {{"beamPeriod", "1e-6"}}, /*is_rolling=*/false);
  EXPECT_EQ(pattern->column_period_s(), 0.0);
  for (const auto& beam : pattern->beams()) EXPECT_EQ(beam.time_s, 0.0);
}

LidarSpec cone_of(int points, double half_rad) {
  LidarSpec spec = spec_of(points, half_rad, 1, 0.0);
  spec.horizontal.min_rad = -half_rad;
  return spec;
}

TEST(RosettePattern, FillsItsConeAndNoScanRepeatsAnother) {
  const double half = deg_to_rad(19.2);
  const auto pattern = pattern_of(cone_of(20000, half), {{"pattern", "rosette"}});
  std::set<std::pair<int, int>> cells_of_one, cells_of_ten;
  double widest = 0.0;
  for (std::uint64_t scan = 0; scan < 10; ++scan) {
    for (std::size_t column = 0; column < pattern->columns(); ++column) {
      for (const Eigen::Vector3d& d : directions(*pattern, scan, column)) {
        EXPECT_NEAR(d.norm(), 1.0, 1e-12);
        widest = std::max(widest, std::acos(d.x()));
        const std::pair<int, int> cell(static_cast<int>(std::floor(d.y() / d.x() * 200.0)),
                                       static_cast<int>(std::floor(d.z() / d.x() * 200.0)));
        cells_of_ten.insert(cell);
        if (scan == 0) cells_of_one.insert(cell);
      }
    }
  }
  EXPECT_NEAR(widest, half, 1e-4);
  EXPECT_GT(cells_of_ten.size(), 2 * cells_of_one.size());
}

TEST(RosettePattern, IsTheSumOfTwoTurningBends) {
  const double half = deg_to_rad(19.2), rpm = 2.0 * kPi / 60.0;
  const auto pattern = pattern_of(cone_of(800, half), {{"pattern", "rosette"}});
  EXPECT_NEAR(pattern->column_period_s() * static_cast<double>(pattern->columns()), 0.1, 1e-12);
  for (const std::uint64_t scan : {std::uint64_t{0}, std::uint64_t{7}}) {
    const auto beams = directions(*pattern, scan, 31);
    for (std::size_t i = 0; i < beams.size(); ++i) {
      const double t = 0.1 * static_cast<double>(scan) + 31 * pattern->column_period_s() +
                       pattern->beams()[i].time_s;
      const double w1 = 7294.0 * rpm, w2 = -4664.0 * rpm, reach = 0.5 * std::tan(half);
      EXPECT_NEAR(beams[i].y() / beams[i].x(), reach * (std::cos(w1 * t) + std::cos(w2 * t)), 1e-9);
      EXPECT_NEAR(beams[i].z() / beams[i].x(), reach * (std::sin(w1 * t) + std::sin(w2 * t)), 1e-9);
    }
  }
}

TEST(LidarPattern, BadValuesAreRefusedByName) {
  const LidarSpec spec = spec_of(100, 6.0, 4, 0.2);
  const auto refusal = [&](const LidarSpec& of, const ParamList& params) {
    return error_of([&] { pattern_of(of, params); });
  };
  EXPECT_TRUE(contains(refusal(spec, {{"pattern", "spiral"}}), "rings or rosette"));
  for (const char* order : {"0 1 2", "0 1 2 4", "0 0 1 2", "0 1 2 x", "0 1 2 2.5"}) {
    const std::string error = refusal(spec, {{"firingOrder", order}});
    EXPECT_TRUE(contains(error, "<firingOrder>"));
    EXPECT_TRUE(contains(error, order));
  }
  for (const char* elevations : {"0 1", "0 0.2 0.1 0.3", "0 0.1 0.2 2", "0 0.1 0.2 nan"}) {
    EXPECT_TRUE(contains(refusal(spec, {{"elevations", elevations}}), "<elevations>"));
  }
  EXPECT_TRUE(contains(refusal(spec, {{"beamPeriod", "0.01"}}), "<beamPeriod>"));
  EXPECT_TRUE(contains(refusal(spec, {{"pattern", "rosette"}}), "angles of -a and a"));
  EXPECT_TRUE(contains(refusal(cone_of(20, 0.3), {{"pattern", "rosette"}}), "multiple of 8"));
}

}  // namespace
}  // namespace trident::sim
