// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/particle_slam_2d.h"

#include <gtest/gtest.h>

#include <cmath>

#include "conformance/scan_world.h"
#include "grids/tiled_grid.h"
#include "particle_slam/proposal.h"

namespace trident::slam {
namespace {

using testing_world::ScanWorld;

const ScanWorld& world() {
  static const ScanWorld instance(5);
  return instance;
}

TEST(TiledGrid, ACopyKeepsItsOwnCells) {
  TiledGrid<int> a;
  a.at(-40, 100) = 7;
  TiledGrid<int> b = a;
  b.at(-40, 100) = 8;
  b.at(500, 500) = 9;
  EXPECT_EQ(a.get(-40, 100), 7);
  EXPECT_EQ(a.get(500, 500), 0);
  EXPECT_EQ(b.get(-40, 100), 8);
  a.at(-40, 100) = 1;
  EXPECT_EQ(b.get(-40, 100), 8);
}

TEST(TiledGrid, CoversWhatWasWritten) {
  TiledGrid<char> grid;
  grid.at(-33, 5) = 1;
  grid.at(70, -90) = 1;
  const auto extent = grid.extent();  // in whole tiles of 32 cells, and no more
  EXPECT_EQ(extent.min_x, -64);
  EXPECT_EQ(extent.min_y, -96);
  EXPECT_EQ(extent.width, 160);
  EXPECT_EQ(extent.height, 128);
  EXPECT_EQ(TiledGrid<char>().extent().width, 0);
  EXPECT_EQ(grid.get(1000, -1000), 0);
}

class ProposalTest : public testing::Test {
 protected:
  ProposalTest() {
    for (int i = 0; i < 3; ++i) map_.insert(SE2::identity(), scan_);
    motion_.covariance = Eigen::Vector3d(0.01, 0.01, 0.0025).asDiagonal();
  }
  ProbabilityGrid map_{0.05, 0.4, 0.8};
  PointScan scan_ = make_point_scan(world().steps()[0].scan, {});
  PoseGaussian motion_;
};

TEST_F(ProposalTest, FindsThePoseThatTheScanDetermines) {
  motion_.T_map_base = SE2::from_xy_yaw(0.05, -0.04, 0.02);
  const Proposal proposal = propose(map_, scan_, motion_, 0.3);
  EXPECT_LT(proposal.pose.T_map_base.p.norm(), 0.02);
  EXPECT_LT(std::abs(proposal.pose.T_map_base.angle), 0.006);
  EXPECT_LT(proposal.pose.covariance.determinant(), motion_.covariance.determinant());
}

TEST_F(ProposalTest, AMapThatFitsHasMoreEvidence) {
  PointScan elsewhere = make_point_scan(world().steps()[60].scan, {});
  const Proposal fits = propose(map_, scan_, motion_, 0.3);
  const Proposal other = propose(map_, elsewhere, motion_, 0.3);
  EXPECT_GT(fits.log_evidence, other.log_evidence + 1.0);
  EXPECT_GT(fits.score, other.score);
}

TEST_F(ProposalTest, WithoutAMapItIsTheMotion) {
  const ProbabilityGrid empty(0.05, 0.4, 0.8);
  motion_.T_map_base = SE2::from_xy_yaw(1.0, 2.0, 0.3);
  const Proposal proposal = propose(empty, scan_, motion_, 0.3);
  EXPECT_LT((proposal.pose.T_map_base.p - motion_.T_map_base.p).norm(), 1e-9);
  EXPECT_LT((proposal.pose.covariance - motion_.covariance).norm(), 1e-9);
}

double last_error(const ParticleSlamParams& params) {
  ParticleSlam2d slam(params);
  for (const auto& step : world().steps()) slam.add_scan(step.scan, step.T_odom_base);
  return (slam.trajectory().back().T_map_base.p - world().steps().back().T_start_base.p).norm();
}

TEST(ParticleSlam2d, OneParticleAndManyTrackThePath) {
  ParticleSlamParams params;
  params.particles = 1;
  EXPECT_LT(last_error(params), 0.2);
  params.particles = 10;
  params.resampleThreshold = 1.0;  // drawn at every update
  EXPECT_LT(last_error(params), 0.2);
}

TEST(ParticleSlam2d, EntropyIsBetweenNoneAndThatOfEqualWeights) {
  ParticleSlamParams params;
  params.particles = 8;
  ParticleSlam2d slam(params);
  EXPECT_NEAR(slam.entropy(), std::log(8.0), 1e-12);
  for (int i = 0; i < 40; ++i) {
    slam.add_scan(world().steps()[i].scan, world().steps()[i].T_odom_base);
    EXPECT_GE(slam.entropy(), 0.0);
    EXPECT_LE(slam.entropy(), std::log(8.0) + 1e-12);
  }
}

}  // namespace
}  // namespace trident::slam
