// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amcl/fast_math.h"
#include "room.h"
#include "trident_estimation/laser_model.h"
#include "trident_estimation/motion_model.h"
#include "trident_estimation/particle_set.h"
#include "trident_maps/grid_matcher.h"

namespace trident::estimation {
namespace {

TEST(FastMath, IsTheMathematicalOne) {
  for (float angle = -12.0F; angle < 12.0F; angle += 0.0137F) {
    float sine = 0.0F, cosine = 0.0F;
    fast::sine_cosine(angle, &sine, &cosine);
    EXPECT_NEAR(sine, std::sin(static_cast<double>(angle)), 3e-7) << angle;
    EXPECT_NEAR(cosine, std::cos(static_cast<double>(angle)), 3e-7) << angle;
    EXPECT_NEAR(fast::wrapped(angle), wrap_to_pi(static_cast<double>(angle)), 2e-6) << angle;
  }
}

TEST(DistanceField, IsExactAndCut) {
  OccupancyGrid grid;
  grid.width = 23;
  grid.height = 17;
  grid.resolution = 0.5;
  grid.cells.assign(23 * 17, OccupancyGrid::kFree);
  const std::pair<int, int> obstacles[] = {{3, 4}, {20, 1}, {11, 16}, {12, 16}, {0, 0}};
  for (const auto& [column, row] : obstacles) grid.cells[grid.index(column, row)] = 100;
  const maps::DistanceField field(grid, 4.0);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      double nearest = 4.0;
      for (const auto& [c, r] : obstacles) {
        nearest = std::min(nearest, 0.5 * std::hypot(c - column, r - row));
      }
      const auto x = static_cast<float>(0.5 * (column + 0.5)),
                 y = static_cast<float>(0.5 * (row + 0.5));
      EXPECT_NEAR(field.at(x, y), nearest, 1e-6) << column << " " << row;
    }
  }
  EXPECT_EQ(field.at(-1.0F, 3.0F), 4.0F) << "outside";
}

TEST(DistanceField, RaysStopAtWallsWithinACell) {
  const OccupancyGrid grid = test_flat();
  const maps::DistanceField field(grid, 2.0);
  EXPECT_NEAR(field.ray({6.0, 4.0}, 0.0, 20.0), 1.0, 0.05);
  EXPECT_NEAR(field.ray({6.0, 4.0}, kPi, 20.0), 5.9, 0.05);
  EXPECT_NEAR(field.ray({6.0, 5.8}, 0.0, 20.0), 5.9, 0.05) << "through the door";
  EXPECT_EQ(field.ray({6.0, 4.0}, 0.0, 0.5), 0.5);
}

TEST(DistanceField, AgreementFallsWhereWallsStandBetween) {
  const OccupancyGrid grid = test_flat();
  const maps::DistanceField field(grid, 2.0);
  const SE2 T_grid_base = SE2::from_xy_yaw(3.0, 3.0, 0.5);
  LaserModelParams params;
  params.laser_max_beams = 180;
  const maps::ScanPoints points =
      select_beams(test_scan(grid, grid.T_map_origin * T_grid_base, 0), params).points;
  EXPECT_GT(maps::scan_agreement(field, points, T_grid_base), 0.98);
  EXPECT_LT(maps::scan_agreement(field, points, SE2::from_xy_yaw(9.0, 4.0, 0.5)), 0.5);
}

TEST(KnownSpace, IsWhatIsFreeOrOccupiedInTheMap) {
  OccupancyGrid grid = test_flat();
  fill(grid, 2.0, 2.0, 3.0, 3.0, OccupancyGrid::kUnknown);
  const maps::KnownSpace known(grid);
  EXPECT_TRUE(known.contains(6.0F, 4.0F));
  EXPECT_TRUE(known.contains(7.05F, 1.0F)) << "a wall";
  EXPECT_FALSE(known.contains(2.5F, 2.5F));
  EXPECT_TRUE(known.contains(1.99F, 2.5F));
  EXPECT_FALSE(known.contains(-0.01F, 4.0F));
  EXPECT_FALSE(known.contains(6.0F, 8.01F));
}

TEST(DistanceField, BeamsThatEndInUnknownSpaceSayNothingUnlessMostDo) {
  const OccupancyGrid world = test_flat();
  const SE2 T_grid_base = SE2::from_xy_yaw(3.0, 3.0, 0.5);
  LaserModelParams params;
  params.laser_max_beams = 180;
  const maps::ScanPoints points =
      select_beams(test_scan(world, world.T_map_origin * T_grid_base, 0), params).points;
  // Strips of the map that are not known; agreement of all beams, and of those that are judged.
  const auto agreements = [&](double from_m, double to_m) {
    OccupancyGrid map = world;
    fill(map, from_m, 0.0, to_m, 8.0, OccupancyGrid::kUnknown);
    const maps::DistanceField field(map, 2.0);
    return std::make_pair(maps::scan_agreement(field, points, T_grid_base),
                          maps::scan_agreement(field, maps::KnownSpace(map), points, T_grid_base));
  };
  EXPECT_LT(agreements(0.0, 1.5).first, 0.8);
  EXPECT_GT(agreements(0.0, 1.5).second, 0.98);
  EXPECT_EQ(agreements(0.0, 12.0).second, 0.0) << "a map of nothing explains nothing";
  const SE2 elsewhere = SE2::from_xy_yaw(9.0, 4.0, 0.5);
  const maps::DistanceField field(world, 2.0);
  EXPECT_EQ(maps::scan_agreement(field, maps::KnownSpace(world), points, elsewhere),
            maps::scan_agreement(field, points, elsewhere))
      << "where all is known";
}

TEST(Kld, IsTheChiSquareBoundOfFox) {
  // n = chi2(k - 1, 0.99) / (2 err): 135.807 for 100 degrees of freedom, 23.209 for 10.
  EXPECT_NEAR(static_cast<double>(kld_sample_size(101, 0.05, 2.326348)), 1358.07, 2.0);
  EXPECT_NEAR(static_cast<double>(kld_sample_size(11, 0.01, 2.326348)), 1160.5, 4.0);
}

TEST(PoseHistogram, FindsTheClustersAndTheirMoments) {
  ParticleSet particles;
  const RandomStream random(3, "clusters");
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const auto n = random.normals4(i, 0);
    const bool is_first = i % 3 != 0;
    // The second one lies across the seam of headings.
    const float heading = is_first ? 1.0F + 0.1F * n[2] : fast::wrapped(3.1F + 0.1F * n[2]);
    particles.push_back((is_first ? 2.0F : 9.0F) + 0.2F * n[0], 5.0F + 0.1F * n[1], heading);
  }
  particles.set_equal_weights();
  PoseHistogram histogram;
  const std::vector<PoseCluster> clusters = histogram.clusters(particles);
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_NEAR(clusters[0].weight, 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(clusters[0].T_grid_base.p.x(), 2.0, 0.02);
  EXPECT_NEAR(clusters[0].covariance(0, 0), 0.04, 0.004);
  EXPECT_NEAR(clusters[0].covariance(2, 2), 0.01, 0.001);
  EXPECT_NEAR(angle_difference(clusters[1].T_grid_base.angle, 3.1), 0.0, 0.02);
}

ParticleSet at_origin(std::size_t count) {
  ParticleSet particles;
  for (std::size_t i = 0; i < count; ++i) particles.push_back(0.0F, 0.0F, 0.0F);
  particles.set_equal_weights();
  return particles;
}

class EveryOdomModel : public ::testing::TestWithParam<OdomModel> {};

TEST_P(EveryOdomModel, WithoutNoiseIsTheMotionItself) {
  MotionModelParams params{GetParam(), 0.0, 0.0, 0.0, 0.0, 0.0};
  MotionModel motion(params, 1);
  for (const SE2& T_old_new :
       {SE2::from_xy_yaw(0.3, 0.1, 0.5), SE2::from_xy_yaw(-0.4, 0.0, 0.0),
        SE2::from_xy_yaw(0.0, 0.0, 3.0), SE2::from_xy_yaw(0.1, -0.6, -2.0)}) {
    ParticleSet particles;
    particles.push_back(1.0F, 2.0F, 0.7F);
    const SE2 expected = SE2::from_xy_yaw(1.0, 2.0, 0.7) * T_old_new;
    motion.apply(T_old_new, 1, particles);
    EXPECT_NEAR((particles.pose(0).p - expected.p).norm(), 0.0, 1e-5);
    EXPECT_NEAR(angle_difference(particles.pose(0).angle, expected.angle), 0.0, 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Amcl, EveryOdomModel,
                         ::testing::Values(OdomModel::kDiff, OdomModel::kOmni,
                                           OdomModel::kDiffCorrected, OdomModel::kOmniCorrected));

TEST(MotionModel, NoiseHasTheSigmaThatAlphasSay) {
  const SE2 ahead = SE2::from_xy_yaw(2.0, 0.0, 0.0);
  for (const auto& [model, sigma] : {std::pair{OdomModel::kDiff, 0.2 * 4.0},
                                     {OdomModel::kDiffCorrected, std::sqrt(0.2 * 4.0)}}) {
    MotionModel motion({model, 0.0, 0.0, 0.2, 0.0, 0.0}, 1);
    ParticleSet particles = at_origin(20000);
    motion.apply(ahead, 1, particles);
    double mean = 0.0, square = 0.0;
    for (const float x : particles.x) {
      mean += static_cast<double>(x) / 20000.0;
      square += static_cast<double>(x) * static_cast<double>(x) / 20000.0;
    }
    EXPECT_NEAR(mean, 2.0, 4.0 * sigma / std::sqrt(20000.0));
    EXPECT_NEAR(std::sqrt(square - mean * mean), sigma, 0.02 * sigma);
  }
}

TEST(LaserModel, NarrowWeightsOfBeamskipDoNotSufferFromAStranger) {
  OccupancyGrid grid = test_flat();
  const SE2 T_grid_base = SE2::from_xy_yaw(3.0, 3.0, 0.5);
  LaserScan scan = test_scan(grid, grid.T_map_origin * T_grid_base, 0, 0.0);
  for (std::size_t i = 40; i < 60; ++i) scan.ranges[i] = 0.5F;  // somebody stands there
  LaserModelParams params;
  params.laser_model_type = LaserModel::kLikelihoodFieldProb;
  params.laser_max_beams = 180;
  std::vector<double> means;
  for (const bool skips : {false, true}) {
    params.do_beamskip = skips;
    LaserModel2d model(grid, params);
    ParticleSet particles;
    for (int i = 0; i < 50; ++i) particles.push_back(3.0F, 3.0F, 0.5F);
    particles.set_equal_weights();
    means.push_back(model.weigh(select_beams(scan, params), particles));
  }
  EXPECT_GT(means[1], 1.3 * means[0]);
}

TEST(SelectBeams, TakesWhatParametersAllow) {
  LaserScan scan;
  scan.angle_increment = 0.01;
  scan.range_min = 0.1;
  scan.range_max = 10.0;
  scan.ranges.assign(100, 5.0F);
  scan.ranges[0] = std::numeric_limits<float>::quiet_NaN();
  scan.ranges[3] = 0.0F;
  scan.ranges[6] = std::numeric_limits<float>::infinity();
  LaserModelParams params;
  params.laser_max_beams = 30;
  const ScanBeams beams = select_beams(scan, params);
  EXPECT_EQ(beams.range.size(), 33U) << "every third of 100, without the NaN";
  EXPECT_EQ(beams.points.p_base.size(), 31U) << "without those two, which are no returns";
  params.laser_max_range = 4.0;
  EXPECT_TRUE(select_beams(scan, params).points.p_base.empty());
}

TEST(GridMatcher, FindsAScanInTheWholeMap) {
  const OccupancyGrid grid = test_flat();
  const maps::GridMatcher matcher(grid);
  LaserModelParams params;
  params.laser_max_beams = 90;
  std::uint64_t number = 0;
  for (const SE2& T_grid_base :
       {SE2::from_xy_yaw(2.0, 3.0, 1.0), SE2::from_xy_yaw(10.0, 4.0, -2.0),
        SE2::from_xy_yaw(5.8, 7.0, 3.0), SE2::from_xy_yaw(9.0, 1.0, 0.0)}) {
    const SE2 T_map_base = grid.T_map_origin * T_grid_base;
    const auto found =
        matcher.match(select_beams(test_scan(grid, T_map_base, ++number), params).points);
    ASSERT_FALSE(found.empty());
    EXPECT_LT((found[0].T_map_base.p - T_map_base.p).norm(), 0.06);
    EXPECT_LT(std::abs(angle_difference(found[0].T_map_base.angle, T_map_base.angle)), 0.02);
    EXPECT_GT(found[0].agreement, 0.95);
  }
}

TEST(GridMatcher, BranchAndBoundFindsWhatTryingEverythingFinds) {
  const OccupancyGrid grid = test_flat();
  maps::GridMatcherParams fast, exhaustive;
  exhaustive.depth = 0;  // one level: every pose of the lattice
  LaserModelParams params;
  params.laser_max_beams = 45;
  const SE2 T_map_base = grid.T_map_origin * SE2::from_xy_yaw(3.3, 6.6, 2.0);
  const maps::ScanPoints points = select_beams(test_scan(grid, T_map_base, 5), params).points;
  const auto a = maps::GridMatcher(grid, fast).match(points);
  const auto b = maps::GridMatcher(grid, exhaustive).match(points);
  ASSERT_FALSE(a.empty());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].score, b[i].score);
    EXPECT_EQ(a[i].T_map_base.p, b[i].T_map_base.p);
  }
}

}  // namespace
}  // namespace trident::estimation
