// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/map/keyframe_map.h"

#include <gtest/gtest.h>

#include "graph_slam/polygon_world.h"
#include "trident_base/error.h"

namespace trident::slam {
namespace {

/// The first `count` keyframes of a drive along the ring.
KeyframeGraph ring_graph(int count) {
  const PolygonWorld world = ring_world();
  const std::vector<SE2> path = ring_path(1.0);
  KeyframeGraph graph(10);
  for (int i = 0; i < count; ++i) {
    const SE2& T = path[static_cast<std::size_t>(4 * i)];
    const LaserScan scan = world.scan(T, static_cast<std::uint64_t>(i));
    graph.add({T, std::make_shared<const PointScan>(make_point_scan(scan, {})), 0.0});
  }
  return graph;
}

void expect_same(const OccupancyGrid& a, const OccupancyGrid& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.T_map_origin.p, b.T_map_origin.p);
  EXPECT_EQ(a.cells, b.cells);
}

TEST(KeyframeMap, BroughtUpToDateItIsAsIfMadeAtOnce) {
  KeyframeMap map(0.05);
  EXPECT_TRUE(map.update(KeyframeGraph(10)).cells.empty());
  for (const int count : {1, 12, 12, 60}) {
    const KeyframeGraph graph = ring_graph(count);
    expect_same(map.update(graph), keyframe_map(graph, 0.05));
  }
}

TEST(KeyframeMap, MovedAndForgottenScansAreDrawnAgain) {
  KeyframeGraph graph = ring_graph(40);
  KeyframeMap map(0.05);
  map.update(graph);
  graph.set_pose(20, SE2::from_xy_yaw(0.3, 0.2, 0.01) * graph.pose(20));
  expect_same(map.update(graph), keyframe_map(graph, 0.05));
  graph.set_scan(3, std::make_shared<const PointScan>());
  const OccupancyGrid without = map.update(graph);
  expect_same(without, keyframe_map(graph, 0.05));
  expect_same(map.update(ring_graph(5)), keyframe_map(ring_graph(5), 0.05));
}

TEST(KeyframeMap, TooLargeAMapIsReported) {
  KeyframeGraph graph = ring_graph(2);
  graph.set_pose(1, SE2::from_xy_yaw(1e5, 1e5, 0.0));
  try {
    KeyframeMap(0.05).update(graph);
    FAIL() << "made";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("legal: up to 2^28"), std::string::npos);
  }
}

}  // namespace
}  // namespace trident::slam
