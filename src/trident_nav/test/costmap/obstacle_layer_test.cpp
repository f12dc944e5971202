// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/obstacle_layer.h"

#include <string>
#include <utility>
#include <vector>

#include "costmap_fixture.h"

namespace trident::nav {
namespace {

/// A layer of 20 x 5 cells of 1 m with one source at (0.5, 2.5), 0.5 m above the ground.
class ObstacleLayerTest : public ::testing::Test {
 protected:
  void make(
      const std::string& source, const std::string& layer = "",
      const std::string& ranges = "clearing: true, obstacle_range: 10, raytrace_range: 15, ") {
    layer_ = new_layer<ObstacleLayer>("{footprint_clearing_enabled: false, " + layer +
                                          " sources: {scan: {" + ranges + source + "}}}",
                                      true);
    layer_->resize(grid_of(20, 5));
  }
  /// Beams that end at places (x, y, z).
  void see(const std::vector<BeamEnd>& ends, const Eigen::Vector3d& origin = {0.5, 2.5, 0.5}) {
    Observation observation;
    observation.stamp_s = now_s_;
    for (BeamEnd end : ends) {
      end.p -= origin.cast<float>();
      observation.ends.push_back(end);
    }
    observation.groups.push_back({origin, 0, ends.size()});
    layer_->sources()[0].add(std::move(observation));
  }
  std::vector<int> row(int y) {
    BlockSet changed(20, 5);
    layer_->update({now_s_, {}}, changed);
    std::vector<std::uint8_t> costs(20, kUnknownCost);
    layer_->combine(y, 0, 20, costs.data());
    return {costs.begin(), costs.end()};
  }
  /// "254" at some places, 0 up to `free`, unknown beyond.
  static std::vector<int> expected(int free, const std::vector<int>& lethal) {
    std::vector<int> costs(20, 255);
    for (int x = 0; x < free; ++x) costs[static_cast<std::size_t>(x)] = 0;
    for (const int x : lethal) costs[static_cast<std::size_t>(x)] = 254;
    return costs;
  }

  double now_s_ = 1.0;
  std::unique_ptr<ObstacleLayer> layer_;
};

TEST_F(ObstacleLayerTest, ABeamClearsUpToItsEndAndMarksThat) {
  make("");
  see({{{6.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(6, {6}));
}

TEST_F(ObstacleLayerTest, WhatIsSeenThroughIsGoneWhateverIsBehind) {
  struct Case {
    const char* what;
    BeamEnd end;
    int free;
    std::vector<int> lethal;
  };
  const std::vector<Case> cases{{"near wall", {{9.5F, 2.5F, 0.5F}, true}, 9, {9}},
                                {"far wall", {{30.5F, 2.5F, 0.5F}, true}, 16, {}},
                                {"high wall", {{9.5F, 2.5F, 2.6F}, true}, 7, {}},
                                {"the ground", {{9.5F, 2.5F, -0.5F}, true}, 6, {}},
                                {"nothing", {{9.5F, 2.5F, 0.5F}, false}, 10, {}}};
  for (const Case& c : cases) {
    make("");
    see({{{4.5F, 2.5F, 0.5F}, true}});
    EXPECT_EQ(row(2), expected(4, {4}));
    see({c.end});
    EXPECT_EQ(row(2), expected(c.free, c.lethal)) << c.what;
  }
}

TEST_F(ObstacleLayerTest, RaysClearBeforePointsMark) {
  make("");
  // The second beam passes the first one's end.
  see({{{6.5F, 2.5F, 0.5F}, true}, {{9.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(9, {6, 9}));
}

TEST_F(ObstacleLayerTest, MarksOutliveObstacleRangeWhileTheyAreSeen) {
  make("");
  see({{{8.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(8, {8}));
  // From 3 m farther away the same wall, also a bit farther, is beyond obstacle_range.
  see({{{8.5F, 2.5F, 0.5F}, true}}, {-3.5, 2.5, 0.5});
  EXPECT_EQ(row(2), expected(8, {8}));
  see({{{9.4F, 2.5F, 0.5F}, true}}, {-3.5, 2.5, 0.5});
  EXPECT_EQ(row(2), expected(9, {8}));
  // But what is seen through is gone, and what was not marked is not marked.
  see({{{11.0F, 2.5F, 0.5F}, true}}, {-3.5, 2.5, 0.5});
  EXPECT_EQ(row(2), expected(11, {}));
}

TEST_F(ObstacleLayerTest, BeamsAreClippedAtTheGrid) {
  make("", "", "clearing: true, obstacle_range: 10, raytrace_range: 100");
  see({{{6.5F, 2.5F, 0.5F}, true}});
  row(2);
  see({{{60.5F, 2.5F, 0.5F}, true}});  // leaves the grid
  EXPECT_EQ(row(2), expected(20, {}));
  make("", "", "clearing: true, obstacle_range: 10, raytrace_range: 100");
  see({{{-9.5F, 2.5F, 0.5F}, true}}, {30.5, 2.5, 0.5});  // passes it
  EXPECT_EQ(row(2), expected(20, {}));
  see({{{25.5F, 9.0F, 0.5F}, true}}, {30.5, 2.5, 0.5});  // misses it
  EXPECT_EQ(row(2), expected(20, {}));
}

TEST_F(ObstacleLayerTest, HeightsAndRangesLimitMarking) {
  make("min_obstacle_height: 0.2, max_obstacle_height: 1.0, obstacle_min_range: 2", "",
       "obstacle_range: 10, ");
  see({{{1.5F, 2.5F, 0.5F}, true},
       {{4.5F, 2.5F, 0.1F}, true},
       {{5.5F, 2.5F, 0.2F}, true},
       {{6.5F, 2.5F, 1.0F}, true},
       {{7.5F, 2.5F, 1.1F}, true},
       {{10.4F, 2.5F, 0.5F}, true},
       {{10.6F, 2.5F, 0.5F}, true},
       {{9.5F, 2.5F, 0.5F}, false}});
  EXPECT_EQ(row(2), expected(0, {5, 6, 10}));
}

TEST_F(ObstacleLayerTest, PersistentDataStayInUse) {
  make("observation_persistence: 1.0");
  see({{{6.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(6, {6}));
  now_s_ = 1.5;
  see({{{9.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(9, {6, 9}));
  now_s_ = 2.1;
  see({{{9.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(9, {9}));
}

TEST_F(ObstacleLayerTest, MarksDecay) {
  make("", "decay_time: 2.0,", "obstacle_range: 10");
  see({{{6.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(0, {6}));
  now_s_ = 2.9;
  see({{{8.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(0, {6, 8}));
  now_s_ = 3.1;
  EXPECT_EQ(row(2), expected(0, {8}));
}

TEST_F(ObstacleLayerTest, TheFootprintsCellsAreFree) {
  make("", "");
  BeamLayerParams params = layer_->beam_params();
  params.footprint_clearing_enabled = true;
  layer_->set_beam_params(params);
  layer_->set_footprint({{{0.6, -0.4}, {0.6, 0.4}, {-0.4, 0.4}, {-0.4, -0.4}}, 0.4, 0.72});
  see({{{6.5F, 2.5F, 0.5F}, true}});
  BlockSet changed(20, 5);
  layer_->update({now_s_, {5.5, 2.5, 0.0}}, changed);
  std::vector<std::uint8_t> costs(20, kUnknownCost);
  layer_->combine(2, 0, 20, costs.data());
  EXPECT_EQ((std::vector<int>{costs.begin(), costs.end()}), expected(7, {}));
}

TEST_F(ObstacleLayerTest, ForgettingKeepsWhatIsSeenNow) {
  make("");
  see({{{6.5F, 2.5F, 0.5F}, true}});
  row(2);
  see({{{4.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(row(2), expected(6, {4, 6}));
  layer_->forget({3, 0, 20, 5}, Layer::Side::kOutside);
  EXPECT_EQ(row(2), expected(6, {4, 6}));
  layer_->forget({3, 0, 20, 5}, Layer::Side::kInside);
  EXPECT_EQ(row(2), expected(4, {4}));
}

TEST_F(ObstacleLayerTest, CombinationMethods) {
  const std::vector<std::uint8_t> below{0, 100, 254, 255};
  const std::vector<std::vector<int>> expected{{0, 254, 0, 255},     // overwrite
                                               {0, 254, 254, 255},   // maximum
                                               {0, 100, 254, 255},   // nothing
                                               {0, 254, 254, 255}};  // maximum, unknown stays
  for (int method = 0; method < 4; ++method) {
    make("", "combination_method: " + std::to_string(method) + ",",
         "clearing: true, raytrace_range: 2.4");
    see({{{2.5F, 2.5F, 0.5F}, false}, {{1.5F, 2.5F, 0.5F}, true}});
    row(2);  // the layer's: free, lethal, free, unknown
    std::vector<std::uint8_t> costs = below;
    layer_->combine(2, 0, 4, costs.data());
    EXPECT_EQ((std::vector<int>{costs.begin(), costs.end()}),
              expected[static_cast<std::size_t>(method)])
        << method;
  }
  make("", "combination_method: 3,");
  see({{{1.5F, 2.5F, 0.5F}, true}});
  row(2);
  std::vector<std::uint8_t> costs(2, kUnknownCost);
  layer_->combine(2, 0, 2, costs.data());
  EXPECT_EQ(costs, (std::vector<std::uint8_t>{255, 255}));
}

TEST_F(ObstacleLayerTest, AStaleSourceIsNamed) {
  make("topic: /front");
  ASSERT_EQ(layer_->stale_sources(0.0).size(), 1U);
  EXPECT_NE(layer_->stale_sources(0.0)[0].text().find("has sent nothing yet"), std::string::npos);
  for (int k = 0; k < 5; ++k) {
    now_s_ = 10.0 + 0.2 * k;
    see({});
  }
  EXPECT_TRUE(layer_->stale_sources(now_s_ + 0.59).empty());
  const auto stale = layer_->stale_sources(now_s_ + 0.61);
  ASSERT_EQ(stale.size(), 1U);
  EXPECT_EQ(stale[0].text(),
            "scan (topic /front) of layer layer is 0.61 s old, its limit is 0.6 s");
}

}  // namespace
}  // namespace trident::nav
