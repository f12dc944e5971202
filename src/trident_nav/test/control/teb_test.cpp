// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The parts of the timed elastic band: slopes, the solver, bands, paths around obstacles.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "control/scene.h"
#include "control/teb/homotopy_map.h"
#include "control/teb/normal_equations.h"
#include "control/teb/teb_band.h"
#include "control/teb/teb_problem.h"
#include "control/teb/teb_terms.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::nav::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Poses in a row, some of which turn across the cut at pi.
TebBand random_band(std::uint64_t index, std::size_t nodes) {
  const RandomStream random(5, "bands");
  TebBand band;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    const double along = 0.2 + 0.2 * random.uniform(index, 4 * i);
    const double x = band.empty() ? 0.0 : band.back().pose.x + along;
    const double y = 0.3 * random.uniform(index, 4 * i + 1);
    const double yaw = wrap_angle(2.5 + 0.8 * random.uniform(index, 4 * i + 2) + 0.3 * i);
    band.push_back({{x, y, yaw}, 0.1 + 0.3 * random.uniform(index, 4 * i + 3)});
  }
  return band;
}

double* variable(TebBand* band, std::size_t k) {
  TebNode& node = (*band)[k / kTebVariables];
  double* const fields[] = {&node.pose.x, &node.pose.y, &node.pose.yaw, &node.dt_s};
  return fields[k % kTebVariables];
}

// Compares the slopes of a quantity with central differences.
template <std::size_t kNodes>
void expect_slopes(const std::function<TebQuantity<kNodes>(const TebBand&)>& quantity,
                   const char* name) {
  constexpr double kStep = 1e-6;
  for (std::uint64_t index = 0; index < 40; ++index) {
    TebBand band = random_band(index, kNodes);
    const TebQuantity<kNodes> there = quantity(band);
    for (std::size_t k = 0; k < kTebVariables * kNodes; ++k) {
      double* const value = variable(&band, k);
      const double kept = *value;
      *value = kept + kStep;
      const double above = quantity(band).value;
      *value = kept - kStep;
      const double below = quantity(band).value;
      *value = kept;
      const double slope = (above - below) / (2.0 * kStep);
      EXPECT_NEAR(there.slopes[k], slope, 1e-5 * (1.0 + std::fabs(slope)))
          << name << ", band " << index << ", variable " << k;
    }
  }
}

using Segment = std::function<TebQuantity<2>(const SegmentMotion&)>;

void expect_segment_slopes(const Segment& segment, ArcLength length, const char* name) {
  expect_slopes<2>(
      [&](const TebBand& band) { return segment(segment_motion(band[0], band[1], length)); }, name);
}

TEST(TebSlopes, OfMotionsAreTheirDifferences) {
  const auto along = [](const SegmentMotion& m) { return m.along; };
  expect_segment_slopes(along, ArcLength::kChord, "along");
  expect_segment_slopes(along, ArcLength::kExact, "along the arc");
  expect_segment_slopes([](const SegmentMotion& m) { return m.across; }, ArcLength::kChord,
                        "across");
  expect_segment_slopes([](const SegmentMotion& m) { return m.turn; }, ArcLength::kChord, "turn");
  expect_segment_slopes([](const SegmentMotion& m) { return length(m); }, ArcLength::kChord,
                        "length");
  expect_segment_slopes([](const SegmentMotion& m) { return turning_excess(m, 2.0); },
                        ArcLength::kChord, "turning radius");
}

TEST(TebSlopes, OfRatesAndAccelerationsAreTheirDifferences) {
  const auto along = [](const TebBand& band, std::size_t i) {
    return segment_motion(band[i], band[i + 1], ArcLength::kExact).along;
  };
  expect_slopes<2>([&](const TebBand& b) { return rate(along(b, 0), b[0].dt_s); }, "rate");
  expect_slopes<3>(
      [&](const TebBand& b) {
        return acceleration(rate(along(b, 0), b[0].dt_s), rate(along(b, 1), b[1].dt_s), b[0].dt_s,
                            b[1].dt_s);
      },
      "acceleration");
  for (const double sign : {1.0, -1.0}) {
    expect_slopes<2>(
        [&](const TebBand& b) {
          return end_acceleration(rate(along(b, 0), b[0].dt_s), 0.7, b[0].dt_s, sign);
        },
        "acceleration at an end");
  }
  expect_slopes<2>(
      [&](const TebBand& b) {
        return excess(rate(along(b, 0), b[0].dt_s), TebSide::kUnder, -0.1, 0.1);
      },
      "speed limit");
}

TEST(TebSlopes, OfClearancesAreTheirDifferencesForPolygonsAndCirclesOutsideAndInside) {
  const Footprint shapes[] = {jackal().footprint, car().footprint, burger().footprint};
  const RandomStream random(6, "points");
  for (const Footprint& shape : shapes) {
    const FootprintDistance footprint(shape);
    for (std::uint64_t i = 0; i < 20; ++i) {
      const Point2 point{1.2 * random.uniform(i, 0) - 0.6, 1.2 * random.uniform(i, 1) - 0.3};
      expect_slopes<1>(
          [&](const TebBand& b) {
            const Pose2& pose = b[0].pose;
            return clearance(footprint, pose, std::cos(pose.yaw), std::sin(pose.yaw), point, 0.03);
          },
          "clearance");
      expect_slopes<1>([&](const TebBand& b) { return separation(b[0].pose, point); },
                       "separation");
      expect_slopes<1>(
          [&](const TebBand& b) {
            const Pose2& pose = b[0].pose;
            return clearance(pose, std::cos(pose.yaw), std::sin(pose.yaw),
                             {point, {std::cos(0.1 * i), std::sin(0.1 * i)}, 0.7});
          },
          "clearance of a plane");
    }
  }
}

TEST(TebFootprint, DistancesAreThoseOfThePolygonAndNegativeInside) {
  const FootprintDistance body(jackal().footprint);  // 0.42 x 0.33 m
  EXPECT_NEAR(body.to({0.31, 0.0}).distance_m, 0.1, 1e-12);
  EXPECT_NEAR(body.to({0.21 + 0.3, 0.165 + 0.4}).distance_m, 0.5, 1e-12);
  EXPECT_NEAR(body.to({0.0, 0.1}).distance_m, -0.065, 1e-12);
  EXPECT_NEAR(FootprintDistance(burger().footprint).to({0.3, 0.4}).distance_m, 0.395, 1e-12);
  // A corner of an L that a convex hull would fill.
  Footprint corner;
  corner.points = {{-0.2, -0.2}, {0.4, -0.2}, {0.4, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {-0.2, 0.4}};
  EXPECT_NEAR(FootprintDistance(corner).to({0.2, 0.2}).distance_m, 0.1, 1e-12);
}

TEST(NormalEquations, SolveWhatADenseSolverSolves) {
  constexpr std::size_t kNodes = 6;
  const RandomStream random(8, "terms");
  NormalEquations equations;
  equations.reset(kNodes);
  constexpr std::size_t kSize = kNodes * kTebVariables;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(kSize, kSize);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(kSize);
  std::uint64_t sample = 0;
  for (int round = 0; round < 12; ++round) {
    for (std::size_t node = 0; node + 3 <= kNodes; ++node) {
      TebQuantity<3> term;
      term.value = random.normal(++sample, 0);
      for (double& slope : term.slopes) slope = random.normal(++sample, 0);
      equations.add(node, term, 0.5);
      Eigen::VectorXd row = Eigen::VectorXd::Zero(kSize);
      for (std::size_t k = 0; k < term.slopes.size(); ++k) {
        row[static_cast<Eigen::Index>(node * kTebVariables + k)] = term.slopes[k];
      }
      dense += 0.5 * row * row.transpose();
      gradient += 0.5 * term.value * row;
    }
  }
  // A variable that is taken out does not move, and the others do as if it were a constant.
  equations.fix(5);
  dense.row(5).setZero();
  dense.col(5).setZero();
  dense(5, 5) = 1.0;
  gradient[5] = 0.0;
  constexpr double kDamping = 0.3;
  dense.diagonal() *= 1.0 + kDamping;
  const Eigen::VectorXd expected = dense.ldlt().solve(-gradient);
  std::vector<double> step;
  ASSERT_TRUE(equations.solve(kDamping, &step));
  for (std::size_t i = 0; i < kSize; ++i) {
    EXPECT_NEAR(step[i], expected[static_cast<Eigen::Index>(i)], 1e-6) << i;
  }
  TebQuantity<1> bad;
  bad.slopes[0] = std::numeric_limits<double>::quiet_NaN();
  equations.add(0, bad, 1.0);
  EXPECT_FALSE(equations.solve(kDamping, &step));
}

TEST(TebBand, IsResizedToTheWantedDurationsAndKeepsEndsAndSum) {
  TebSpacing spacing;
  spacing.max_step_m = 10.0;
  TebBand band = band_through({{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {4.0, 0.0, 0.5}}, {0.5, 1.0});
  EXPECT_NEAR(duration_s(band), 8.0, 1e-12);
  resize_band(spacing, &band);
  EXPECT_NEAR(duration_s(band), 8.0, 1e-12);
  EXPECT_EQ(band.back().pose.x, 4.0);
  for (std::size_t i = 0; i + 1 < band.size(); ++i) EXPECT_LE(band[i].dt_s, 0.4 + 1e-12);
  for (TebNode& node : band) node.dt_s *= 0.1;
  resize_band(spacing, &band);
  EXPECT_LT(band.size(), 8U);
  EXPECT_GE(band.size(), spacing.min_nodes);
  TebBand shortest = band_through({{0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}}, {0.5, 1.0});
  resize_band(spacing, &shortest);
  EXPECT_EQ(shortest.size(), spacing.min_nodes);
}

TEST(TebBand, BeginsWhereTheRobotHasComeTo) {
  TebBand band = band_through({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {1.0, 1.0});
  move_ends({1.1, 0.1, 0.2}, {3.2, 0.0, 0.0}, 0.0, &band);
  ASSERT_EQ(band.size(), 3U);
  EXPECT_EQ(band.front().pose.y, 0.1);
  EXPECT_EQ(band.back().pose.x, 3.2);
}

TEST(HomotopyMap, SignaturesDistinguishTheSidesOfAnObstacleAndNothingElse) {
  GridWorld world(4.0, 4.0);
  world.fill({1.8, 1.8, 2.2, 2.2});
  const HomotopyMap map(world.grid(), {{0.0, 0.0}, {4.0, 4.0}}, 0.1, UnknownCells::kFree);
  ASSERT_EQ(map.obstacles(), 1U);
  const HSignature above = map.signature({{0.5, 2.0}, {2.0, 3.0}, {3.5, 2.0}});
  const HSignature higher = map.signature({{0.5, 2.0}, {1.0, 3.0}, {2.5, 3.8}, {3.5, 2.0}});
  const HSignature below = map.signature({{0.5, 2.0}, {2.0, 1.0}, {3.5, 2.0}});
  EXPECT_EQ(above, higher);
  EXPECT_NE(above, below);
  EXPECT_EQ(map.signature({{0.5, 2.0}, {2.0, 1.0}, {3.5, 2.0}, {2.0, 3.0}, {0.5, 2.0}}),
            added(below, 0));  // once around, less what the return above does not cross
}

TEST(HomotopyMap,
     FindsAPathOnEitherSideOfAPillarTheShorterOneFirstAndNoneThroughAGapThatIsTooNarrow) {
  GridWorld world(6.0, 4.0);
  world.fill({2.8, 1.5, 3.2, 2.2});
  world.fill({2.8, 2.3, 3.2, 2.8});  // 0.1 m from the other: nothing fits between them
  const HomotopyMap map(world.grid(), {{0.0, 0.0}, {6.0, 4.0}}, 0.165, UnknownCells::kFree);
  const std::vector<HomotopyPath> paths = map.paths({1.0, 1.9}, {5.0, 1.9}, 4, 1.6);
  ASSERT_EQ(map.obstacles(), 1U);
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_LE(paths[0].length_m, paths[1].length_m);
  EXPECT_NE(paths[0].signature, paths[1].signature);
  for (const HomotopyPath& path : paths) EXPECT_EQ(map.signature(path.points), path.signature);
}

TEST(HomotopyMap, AGoalBehindAWallHasNoPath) {
  GridWorld world(4.0, 4.0);
  world.fill({2.0, 0.0, 2.1, 4.0});
  const HomotopyMap map(world.grid(), {{0.0, 0.0}, {4.0, 4.0}}, 0.1, UnknownCells::kFree);
  EXPECT_TRUE(map.paths({1.0, 2.0}, {3.0, 2.0}, 4, 2.0).empty());
}

}  // namespace
}  // namespace trident::nav::testing
