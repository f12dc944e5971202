// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/incremental_pose_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pose_graph/random_graphs.h"
#include "trident_base/error.h"

namespace trident::slam {
namespace {

template <class Group>
class IncrementalPoseGraphTest : public testing::Test {
 protected:
  /// Adds vertex k with its edges to those before it.
  void add(int k) {
    std::vector<typename PoseGraph<Group>::Edge> edges;
    for (const auto& edge : whole_.edges()) {
      if (std::max(edge.from, edge.to) == k) edges.push_back(edge);
    }
    growing_.add(k, whole_.pose(k), edges);
  }
  /// chi2 of the optimum of what has been added.
  double best() const {
    PoseGraph<Group> graph = growing_.graph();
    return PoseGraphOptimizer<Group>().optimize(graph).chi2_after;
  }

  static constexpr int kVertices = 150;
  PoseGraph<Group> whole_ = grid_graph<Group>(10, kVertices / 10, 0.05, 3);
  IncrementalPoseGraph<Group> growing_;
};

using IncrementalGroups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(IncrementalPoseGraphTest, IncrementalGroups);

TYPED_TEST(IncrementalPoseGraphTest, IsNearTheOptimumAtAnyTimeAndAtItInTheEnd) {
  for (int k = 0; k < this->kVertices; ++k) {
    this->add(k);
    if (k % 10 != 9) continue;
    const double best = this->best();
    EXPECT_LT(pose_graph_chi2(this->growing_.graph()), 1.3 * best + 1.5) << "vertex " << k;
  }
  EXPECT_LT(this->growing_.optimizations(), this->kVertices * 3 / 4);
  this->growing_.finish();
  PoseGraph<TypeParam> at_once = this->whole_;
  const double best = PoseGraphOptimizer<TypeParam>().optimize(at_once).chi2_after;
  EXPECT_NEAR(pose_graph_chi2(this->growing_.graph()), best, 1e-5 * best);
}

TYPED_TEST(IncrementalPoseGraphTest, OdometryAloneNeedsNoOptimisation) {
  for (int k = 0; k < 15; ++k) this->add(k);  // the first row, beside which there is none
  EXPECT_EQ(this->growing_.optimizations(), 0);
  EXPECT_LT(pose_graph_chi2(this->growing_.graph()), 1e-12);
}

TEST(IncrementalOptionsTest, NamesWhatIsWrong) {
  IncrementalOptions options;
  options.share = -0.5;
  try {
    IncrementalPoseGraph<SE2> graph(options);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "incremental pose graph: share is -0.5, but must be >= 0");
  }
}

}  // namespace
}  // namespace trident::slam
