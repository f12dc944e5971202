// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "graph_slam/backend/scan_pruner.h"
#include "graph_slam/polygon_world.h"
#include "trident_slam/graph_slam_2d.h"

namespace trident::slam {
namespace {

/// A room of 9 m by 7 m with a niche and a pillar, and a cupboard with its corner at `x`, `y`.
PolygonWorld furnished_room(double x, double y) {
  PolygonWorld world;
  world.add_polygon({{0, 0}, {9, 0}, {9, 4}, {9.8, 4}, {9.8, 5}, {9, 5}, {9, 7}, {0, 7}});
  world.add_box(0.0, 2.0, 0.4, 2.6);
  world.add_box(x, y, x + 1.2, y + 0.6);
  return world;
}

/// Around the room's middle, 20 m a round.
std::vector<SE2> room_tour(int rounds) {
  return rectangle_path(SE2::from_xy_yaw(1.5, 1.5, 0.0), 60, 40, 4 * rounds);
}

class LifelongMap : public ::testing::Test {
 protected:
  static GraphSlamOptions lifelong() {
    GraphSlamOptions options;
    options.mode = SlamMode::kLifelong;
    options.keep_scans = false;
    return options;
  }
  /// Drives along the whole path and returns the largest error of a pose.
  static double drive(const PolygonWorld& world, const std::vector<SE2>& path, GraphSlam2d& slam) {
    const std::vector<SE2> odometry = drifting_odometry(path, 1.05, 0.97);
    double largest = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const SE2 T = slam.add_scan(world.scan(path[i], i), odometry[i]).T_map_base;
      largest = std::max(largest, (T.p - (path.front().inverse() * path[i]).p).norm());
    }
    return largest;
  }
  /// The part of the cells on the near side of a cupboard at `x`, `y` that are occupied.
  static double occupied_share(const OccupancyGrid& map, double x, double y) {
    int occupied = 0;
    constexpr int kPlaces = 20;
    for (int i = 0; i < kPlaces; ++i) {
      const Eigen::Vector2d p = Eigen::Vector2d(x + 0.1 + i * 1.0 / kPlaces, y) -
                                Eigen::Vector2d(1.5, 1.5);  // the map begins at the first pose
      bool is_wall = false;
      for (const double off : {-0.05, 0.0, 0.05}) {
        const Eigen::Vector2i cell = map.cell_at(p + Eigen::Vector2d(0.0, off));
        is_wall |= map.cells[map.index(cell.x(), cell.y())] == OccupancyGrid::kOccupied;
      }
      occupied += is_wall ? 1 : 0;
    }
    return static_cast<double>(occupied) / kPlaces;
  }
};

TEST_F(LifelongMap, ShowsFurnitureWhereItIsNowAndNotWhereItWas) {
  const std::string session = ::testing::TempDir() + "/lifelong_room.posegraph";
  GraphSlamOptions options = lifelong();
  options.mode = SlamMode::kMapping;
  GraphSlam2d mapping(options);
  drive(furnished_room(3.0, 3.2), room_tour(4), mapping);
  EXPECT_GT(occupied_share(mapping.map(), 3.0, 3.2), 0.8);
  mapping.save_session(session);
  GraphSlam2d second(lifelong());
  second.load_session(session, SE2::identity());
  EXPECT_LT(drive(furnished_room(5.2, 3.4), room_tour(1), second), 0.06);
  const OccupancyGrid map = second.map();
  EXPECT_GT(occupied_share(map, 5.2, 3.4), 0.8);
  EXPECT_LT(occupied_share(map, 3.0, 3.2), 0.1);
  mapping.load_session(session, SE2::identity());
  drive(furnished_room(5.2, 3.4), room_tour(1), mapping);
  EXPECT_GT(occupied_share(mapping.map(), 3.0, 3.2), 0.5);  // without forgetting
  std::remove(session.c_str());
}

TEST_F(LifelongMap, HasAsManyKeyframesAfterTenToursAsAfterThree) {
  const PolygonWorld world = furnished_room(3.0, 3.2);
  std::vector<int> nodes;
  std::vector<std::size_t> scans;
  GraphSlam2d slam(lifelong());
  GraphSlamOptions options = lifelong();
  options.mode = SlamMode::kMapping;
  GraphSlam2d mapping(options);
  const std::vector<SE2> path = room_tour(10);
  const std::vector<SE2> odometry = drifting_odometry(path, 1.05, 0.97);
  const std::size_t tour = path.size() / 10;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const SE2 T = slam.add_scan(world.scan(path[i], i), odometry[i]).T_map_base;
    ASSERT_LT((T.p - (path.front().inverse() * path[i]).p).norm(), 0.06) << i;
    if (i < 6 * tour) mapping.add_scan(world.scan(path[i], i), odometry[i]);
    if ((i + 1) % tour == 0) nodes.push_back(slam.nodes());
    if ((i + 1) % tour == 0) scans.push_back(slam.trajectory().size());
  }
  // Keyframes are taken out in batches of 20.
  const int bound = *std::max_element(nodes.begin(), nodes.begin() + 4) + 20;
  EXPECT_LT(*std::max_element(nodes.begin() + 4, nodes.end()), bound);
  EXPECT_LT(*std::max_element(scans.begin() + 4, scans.end()), 2 * scans[3]);
  EXPECT_GT(mapping.nodes(), 2 * bound);  // a map that forgets nothing
  EXPECT_GT(occupied_share(slam.map(), 3.0, 3.2), 0.8);
}

/// Keyframes in a row along x, each with one point `ahead` of it.
KeyframeGraph row(int count, float ahead) {
  KeyframeGraph graph(10);
  for (int i = 0; i < count; ++i) {
    auto scan = std::make_shared<PointScan>();
    scan->points.push_back({{ahead, 0.0F}, {-1.0F, 0.0F}});
    graph.add({SE2::from_xy_yaw(i, 0.0, 0.0), scan, static_cast<double>(i)});
    if (i > 0) graph.add_edge({i - 1, i, SE2::from_xy_yaw(1.0, 0.0, 0.0)});
  }
  return graph;
}

TEST(KeyframeGraphRemoval, EdgesGoToTheKeyframesNextToThoseThatAreTakenOut) {
  KeyframeGraph graph = row(8, 1.0F);
  GraphEdge loop{1, 6, SE2::from_xy_yaw(5.0, 0.0, 0.0)};
  loop.kind = EdgeKind::kLoop;
  graph.add_edge(loop);
  const KeyframeGraph::Removal removal = graph.remove({0, 1, 1, 0, 1, 1, 1, 0});
  EXPECT_EQ(removal.kept, (std::vector<int>{0, 3, 7}));
  EXPECT_EQ(removal.stand_in, (std::vector<int>{0, 0, 1, 1, 1, 2, 2, 2}));
  ASSERT_EQ(graph.edges().size(), 3U);
  for (const GraphEdge& edge : graph.edges()) {  // all were true, and still are
    EXPECT_LT(edge_error(edge, graph.pose(edge.from), graph.pose(edge.to)).norm(), 1e-12);
  }
  EXPECT_EQ(graph.edges().back().kind, EdgeKind::kLoop);
  EXPECT_EQ(graph.edges().back().from, 0);
  EXPECT_EQ(graph.edges().back().to, 2);
}

TEST(ScanPruner, WhatNobodyHasSeenAgainStays) {
  KeyframeGraph graph(10);
  const auto scan = [](const std::vector<Eigen::Vector2f>& points) {
    auto result = std::make_shared<PointScan>();
    for (const Eigen::Vector2f& p : points) result->points.push_back({p, {0.0F, 0.0F}});
    return result;
  };
  graph.add({SE2::identity(), scan({{4.0F, 3.0F}, {4.0F, -3.0F}, {-2.0F, 1.0F}}), 0.0});
  ScanPruner scan_pruner{LifelongOptions{}};
  for (int i = 1; i < 12; ++i) {  // these see two of its three points again
    graph.add({SE2::identity(), scan({{4.0F, 3.0F}, {4.0F, -3.0F}}), 30.0 * i});
    for (const int stale : scan_pruner.update(graph).replaced) EXPECT_NE(stale, 0);
  }
  graph.add({SE2::identity(), scan({{4.0F, 3.0F}, {4.0F, -3.0F}, {-2.0F, 1.0F}}), 400.0});
  const std::vector<int> stale = scan_pruner.update(graph).replaced;
  EXPECT_EQ(std::count(stale.begin(), stale.end(), 0), 1);
}

TEST(ScanPruner, WhatIsSeenThroughGoesAtOnceAndWhatIsHiddenStays) {
  const auto wall = [](float x) {
    auto result = std::make_shared<PointScan>();
    for (int i = -30; i <= 30; ++i) {
      result->points.push_back({{x, 0.05F * static_cast<float>(i)}, {-1.0F, 0.0F}});
    }
    return result;
  };
  KeyframeGraph graph(10);
  graph.add({SE2::identity(), wall(3.0F), 0.0});
  graph.add({SE2::identity(), wall(5.0F), 30.0});
  const PruneResult through = ScanPruner(LifelongOptions{}).update(graph);
  ASSERT_EQ(through.thinned.size(), 1U);
  for (const SurfacePoint& point : through.thinned[0].second->points) {
    EXPECT_GT(std::abs(point.p.y()) / 3.0F, 1.4F / 5.0F);  // outside what the new scan saw
  }
  EXPECT_GT(through.thinned[0].second->points.size(), 10U);
  KeyframeGraph hidden(10);
  hidden.add({SE2::identity(), wall(5.0F), 0.0});
  hidden.add({SE2::identity(), wall(3.0F), 30.0});
  const PruneResult behind = ScanPruner(LifelongOptions{}).update(hidden);
  EXPECT_TRUE(behind.replaced.empty());
  EXPECT_TRUE(behind.thinned.empty());
}

}  // namespace
}  // namespace trident::slam
