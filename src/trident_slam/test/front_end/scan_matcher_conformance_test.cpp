// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What ScanMatcher promises, asked of every matcher of the registry.
#include "trident_slam/scan_matcher.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <map>

#include "graph_slam/polygon_world.h"

namespace trident::slam {
namespace {

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

std::vector<std::string> matcher_names() {
  Registry<ScanMatcherFactory> registry("scan matcher");
  register_builtin_scan_matchers(registry);
  return registry.names();
}

/// From how far each finds back in a room, and how near: without a prior, one centimetre of noise.
struct Expected {
  double far, far_yaw;    ///< of the guess [m], [rad]
  double near, near_yaw;  ///< of the match
};
const std::map<std::string, Expected>& expected() {
  static const std::map<std::string, Expected> table = {
      {"correlative", {0.45, 0.3, 0.02, 0.006}},   {"grid_gauss_newton", {0.25, 0.2, 0.03, 0.01}},
      {"hybrid", {0.45, 0.3, 0.015, 0.005}},       {"ndt", {0.4, 0.3, 0.02, 0.006}},
      {"point_to_line", {0.3, 0.2, 0.015, 0.005}},
  };
  return table;
}

PolygonWorld room() {
  PolygonWorld world;
  world.add_polygon(
      {{-4, -3}, {4, -3}, {4, 1}, {5.5, 1}, {5.5, 3}, {-4, 3}, {-4, 0.5}, {-5, -0.5}});
  world.add_box(-2.0, 1.2, -1.2, 2.0);
  world.add_box(1.5, -2.0, 1.8, -1.7);
  return world;
}

/// A long_corridor of 2.4 m, so long that no scan sees an end, turned by `kCorridorYaw`.
constexpr double kCorridorYaw = 0.6;
PolygonWorld long_corridor() {
  const SE2 turn = SE2::from_xy_yaw(0.0, 0.0, kCorridorYaw);
  PolygonWorld world;
  world.add_polygon({turn * Eigen::Vector2d(-60, -1), turn * Eigen::Vector2d(60, -1),
                     turn * Eigen::Vector2d(60, 1.4), turn * Eigen::Vector2d(-60, 1.4)});
  return world;
}

/// What one sees from a place, of every `stride`-th beam.
PointScan scan_seen(const PolygonWorld& world, const SE2& T, std::uint64_t index, int stride = 1,
                    double sigma = 0.01) {
  const LaserScan all = world.scan(T, index, sigma);
  LaserScan scan = all;
  scan.angle_increment *= stride;
  scan.ranges.clear();
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(stride)) {
    scan.ranges.push_back(all.ranges[i]);
  }
  return make_point_scan(scan, {});
}

/// Scans from places about the origin as one reference, in a frame of its own.
const SE2 kRefWorld = SE2::from_xy_yaw(7.0, -4.0, 0.9).inverse();
std::vector<PlacedPoints> submap(const PolygonWorld& world, std::uint64_t seed, int stride = 1,
                                 double sigma = 0.01) {
  std::vector<PlacedPoints> scans;
  std::uint64_t index = seed;
  for (const auto& [x, y, yaw] :
       {std::array{-1.0, 0.0, 0.0}, std::array{-0.3, 0.3, 0.7}, std::array{0.3, 0.2, 2.5},
        std::array{0.6, -0.4, -1.5}, std::array{1.0, 0.0, 0.4}, std::array{0.0, -0.3, -2.6}}) {
    const SE2 T = SE2::from_xy_yaw(x, y, yaw);
    scans.push_back({kRefWorld * T, scan_seen(world, T, index++, stride, sigma)});
  }
  return scans;
}

double apart(const SE2& a, const SE2& b) { return (a.p - b.p).norm(); }
double turned(const SE2& a, const SE2& b) { return std::abs(angle_difference(a.angle, b.angle)); }
bool is_same(const SE2& a, const SE2& b) { return a.p == b.p && a.angle == b.angle; }

class ScanMatcherConformance : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<ScanMatcher> make(const PolygonWorld& world, std::uint64_t seed = 100,
                                    double sigma = 0.01) const {
    auto matcher = make_scan_matcher(GetParam());
    matcher->set_reference(submap(world, seed, 1, sigma));
    return matcher;
  }
  Expected limits() const { return expected().at(GetParam()); }
};

TEST_P(ScanMatcherConformance, FindsThePoseInARoom) {
  const PolygonWorld world = room();
  const auto matcher = make(world);
  const RandomStream random(1, "guesses");
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto uniform = [&](std::uint32_t channel, double amount) {
      return amount * (2.0 * random.uniform(i, channel) - 1.0);
    };
    const SE2 truth = SE2::from_xy_yaw(uniform(0, 0.8), uniform(1, 0.6), uniform(2, kPi));
    const double bearing = uniform(3, kPi);
    const double far = limits().far;
    const SE2 off(SE2::from_xy_yaw(far * std::cos(bearing), far * std::sin(bearing),
                                   uniform(4, limits().far_yaw)));
    const SE2 guess = kRefWorld * truth * off;
    const ScanMatch match = matcher->match(scan_seen(world, truth, 200 + i), guess);
    EXPECT_EQ(match.problem, "");
    EXPECT_TRUE(match.is_converged) << i;
    EXPECT_GT(match.inlier_fraction, 0.9) << i;
    EXPECT_GT(match.score, 0.4) << i;
    EXPECT_LE(match.score, 1.0) << i;
    EXPECT_FALSE(match.degeneracy.is_degenerate()) << match.degeneracy.ratio;
    EXPECT_LT(apart(match.T_ref_base, kRefWorld * truth), limits().near) << i;
    EXPECT_LT(turned(match.T_ref_base, kRefWorld * truth), limits().near_yaw) << i;
  }
}

TEST_P(ScanMatcherConformance, ItsCovarianceIsThatOfItsErrors) {
  const PolygonWorld world = room();
  const RandomStream random(2, "poses");
  constexpr int kTrials = 40;
  constexpr double kNoise = 0.03;  // [m], that of the scanners which the covariances are meant for
  double sum = 0.0;
  for (std::uint64_t i = 0; i < kTrials; ++i) {
    const auto matcher = make(world, 1000 + 10 * i, kNoise);
    const SE2 truth = SE2::from_xy_yaw(0.5 * random.normal(i, 0), 0.4 * random.normal(i, 1),
                                       kPi * random.uniform(i, 2));
    const SE2 guess = kRefWorld * truth * SE2::from_xy_yaw(0.02, -0.02, 0.01);
    const ScanMatch match = matcher->match(scan_seen(world, truth, 5000 + i, 1, kNoise), guess);
    const SE2 T = kRefWorld * truth;
    const Eigen::Vector3d error(match.T_ref_base.p.x() - T.p.x(), match.T_ref_base.p.y() - T.p.y(),
                                angle_difference(match.T_ref_base.angle, T.angle));
    sum += error.dot(match.covariance.inverse() * error);
  }
  // Three on average if the errors were Gaussian and the covariance exact. Errors of the reference
  // are common to all points and are not, so that a factor of two is granted.
  EXPECT_GT(sum / kTrials, 3.0 / 2.0);
  EXPECT_LT(sum / kTrials, 3.0 * 2.0);
  RecordProperty("nees", std::to_string(sum / kTrials));
}

TEST_P(ScanMatcherConformance, ACorridorIsDegenerateAlongItself) {
  const PolygonWorld world = long_corridor();
  const auto matcher = make(world);
  const Eigen::Vector2d along =
      kRefWorld.rotation() * Eigen::Vector2d(std::cos(kCorridorYaw), std::sin(kCorridorYaw));
  const Eigen::Vector2d across(-along.y(), along.x());
  const SE2 truth = SE2::from_xy_yaw(0.2, 0.0, 0.3);
  SE2 guess = kRefWorld * truth;
  guess.p += 0.1 * along + 0.05 * across;
  const ScanMatch match = matcher->match(scan_seen(world, truth, 300), guess);
  ASSERT_EQ(match.problem, "");
  EXPECT_TRUE(match.degeneracy.is_degenerate()) << match.degeneracy.ratio;
  EXPECT_GT(std::abs(match.degeneracy.weakest.head<2>().dot(along)), 0.98);
  const Eigen::Matrix2d spread = match.covariance.topLeftCorner<2, 2>();
  EXPECT_GT(along.dot(spread * along), 50.0 * across.dot(spread * across));
  // Across, the walls give the pose; along, it stays where it was guessed.
  const Eigen::Vector2d error = match.T_ref_base.p - (kRefWorld * truth).p;
  EXPECT_LT(std::abs(across.dot(error)), 0.03);
  EXPECT_NEAR(along.dot(error), 0.1, 0.02);
  EXPECT_LT(turned(match.T_ref_base, kRefWorld * truth), 0.01);
}

TEST_P(ScanMatcherConformance, APriorDeterminesWhatACorridorDoesNot) {
  const PolygonWorld world = long_corridor();
  const auto matcher = make(world);
  const SE2 truth = SE2::from_xy_yaw(0.2, 0.0, 0.3);
  PosePrior prior;
  prior.T_ref_base = kRefWorld * truth;
  prior.information = Eigen::Vector3d(2500.0, 2500.0, 2500.0).asDiagonal();  // 2 cm, 0.02 rad
  const ScanMatch match = matcher->match(scan_seen(world, truth, 300), prior.T_ref_base, prior);
  EXPECT_LT(apart(match.T_ref_base, kRefWorld * truth), 0.04);
  const Eigen::Vector3d sigma = match.covariance.diagonal().cwiseSqrt();
  EXPECT_LT(sigma.maxCoeff(), 0.021) << "never less certain than the prior";
}

TEST_P(ScanMatcherConformance, FewBeamsAreEnough) {
  const PolygonWorld world = room();
  const auto matcher = make_scan_matcher(GetParam());
  matcher->set_reference(submap(world, 400, 6));
  const SE2 truth = SE2::from_xy_yaw(0.1, 0.1, 0.2);
  const PointScan scan = scan_seen(world, truth, 450, 6);
  ASSERT_EQ(scan.points.size(), 30U);
  const ScanMatch match =
      matcher->match(scan, kRefWorld * truth * SE2::from_xy_yaw(0.06, -0.05, 0.04));
  EXPECT_EQ(match.problem, "");
  EXPECT_LT(apart(match.T_ref_base, kRefWorld * truth), 0.06);
  EXPECT_LT(turned(match.T_ref_base, kRefWorld * truth), 0.03);
}

TEST_P(ScanMatcherConformance, TheSameCallsGiveTheSameBits) {
  const PolygonWorld world = room();
  const auto a = make(world);
  const auto b = make(world, 700);  // another reference before
  b->set_reference(submap(world, 100));
  const PointScan scan = scan_seen(world, SE2::from_xy_yaw(0.3, 0.1, 0.2), 500);
  const SE2 guess = kRefWorld * SE2::from_xy_yaw(0.4, 0.05, 0.25);
  const ScanMatch first = a->match(scan, guess);
  for (const ScanMatch& again : {a->match(scan, guess), b->match(scan, guess)}) {
    EXPECT_TRUE(is_same(first.T_ref_base, again.T_ref_base));
    EXPECT_EQ(first.covariance, again.covariance);
    EXPECT_EQ(first.score, again.score);
  }
}

TEST_P(ScanMatcherConformance, WhatCannotBeMatchedIsReportedAndLeavesTheGuess) {
  const PolygonWorld world = room();
  const auto matcher = make(world);
  const PointScan good = scan_seen(world, SE2::identity(), 600);
  const SE2 guess = kRefWorld * SE2::from_xy_yaw(0.1, 0.1, 0.1);
  PosePrior prior;
  prior.T_ref_base = guess;
  prior.information = Eigen::Vector3d(100.0, 100.0, 400.0).asDiagonal();
  const auto problem_of = [&](const ScanMatcher& by, const PointScan& scan) {
    const ScanMatch match = by.match(scan, guess, prior);
    EXPECT_TRUE(is_same(match.T_ref_base, guess));
    EXPECT_FALSE(match.is_converged);
    EXPECT_NEAR(match.covariance(0, 0), 0.01, 1e-4);
    return match.problem;
  };
  PointScan bad = good;
  bad.points[3].p.x() = kNotANumber;
  bad.points[9].normal.y() = kNotANumber;
  EXPECT_EQ(problem_of(*matcher, bad),
            "2 of " + std::to_string(bad.points.size()) + " points are not finite");
  EXPECT_EQ(problem_of(*matcher, {}), "0 points, legal: at least 5");
  PointScan few = good;
  few.points.resize(4);
  EXPECT_EQ(problem_of(*matcher, few), "4 points, legal: at least 5");
  PointScan elsewhere = good;
  for (SurfacePoint& point : elsewhere.points) point.p += Eigen::Vector2f(500.0F, 0.0F);
  EXPECT_NE(problem_of(*matcher, elsewhere), "");
  EXPECT_EQ(problem_of(*make_scan_matcher(GetParam()), good), "the reference has no points");
  const SE2 nowhere = SE2::from_xy_yaw(static_cast<double>(kNotANumber), 0.0, 0.0);
  EXPECT_EQ(matcher->match(good, nowhere).problem, "the guess is not finite");
  prior.information(0, 0) = static_cast<double>(kNotANumber);
  EXPECT_EQ(matcher->match(good, guess, prior).problem, "the prior is not finite");
}

TEST_P(ScanMatcherConformance, BadPointsOfTheReferenceHarmNothing) {
  const PolygonWorld world = room();
  std::vector<PlacedPoints> scans = submap(world, 100);
  for (PlacedPoints& placed : scans)
    placed.scan.points.push_back({{kNotANumber, 1.0F}, {0.0F, 1.0F}});
  scans.push_back({SE2::from_xy_yaw(static_cast<double>(kNotANumber), 0.0, 0.0), scans[0].scan});
  const auto matcher = make_scan_matcher(GetParam());
  matcher->set_reference(scans);
  const PointScan scan = scan_seen(world, SE2::identity(), 600);
  const SE2 guess = kRefWorld * SE2::from_xy_yaw(0.05, 0.0, 0.0);
  EXPECT_TRUE(
      is_same(matcher->match(scan, guess).T_ref_base, make(world)->match(scan, guess).T_ref_base));
}

INSTANTIATE_TEST_SUITE_P(Matchers, ScanMatcherConformance, testing::ValuesIn(matcher_names()),
                         [](const auto& info) { return info.param; });

TEST(ScanMatcherRegistry, AnUnknownNameIsAnErrorWithTheLegalOnes) {
  try {
    make_scan_matcher("icp");
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string text = error.what();
    for (const std::string& name : matcher_names()) {
      EXPECT_NE(text.find(name), std::string::npos) << text;
    }
  }
}

TEST(ScanMatcherRegistry, AnOptionOutOfItsRangeIsAnError) {
  ScanMatcherOptions options;
  options.search_resolution = 0.0;
  EXPECT_THROW(make_scan_matcher("correlative", options), Error);
  EXPECT_THROW(make_scan_matcher("hybrid", options), Error);
}

}  // namespace
}  // namespace trident::slam
