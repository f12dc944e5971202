// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/incremental_pose_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pose_graph/pose_system.h"
#include "pose_graph/random_graphs.h"
#include "trident_base/error.h"

namespace trident::slam {
namespace {

template <class Group>
class IncrementalPoseGraphTest : public testing::Test {
 protected:
  using Edges = std::vector<typename PoseGraph<Group>::Edge>;

  /// Edges of vertex k to those before.
  Edges edges_of(int k) const {
    Edges edges;
    for (const auto& edge : whole_.edges()) {
      if (std::max(edge.from, edge.to) == k) edges.push_back(edge);
    }
    return edges;
  }
  void add(int k) { growing_.add(k, whole_.pose(k), edges_of(k)); }
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
  for (int k = 0; k < 15; ++k) this->add(k);  // the first row, without one next to it
  EXPECT_EQ(this->growing_.optimizations(), 0);
  EXPECT_LT(pose_graph_chi2(this->growing_.graph()), 1e-12);
}

TYPED_TEST(IncrementalPoseGraphTest, TakesTheStepsOfIterationsThatEachStartAgain) {
  PoseGraphOptions options;
  options.max_iterations = 1;
  const IncrementalOptions when;
  PoseGraph<TypeParam> graph;
  double chi2 = 0.0;
  for (int k = 0; k < this->kVertices; ++k) {
    this->add(k);
    const auto edges = this->edges_of(k);
    graph.add_vertex(k,
                     k == 0 ? this->whole_.pose(0) : graph.pose(k - 1) * edges.front().T_from_to);
    for (const auto& edge : edges) graph.add_edge(edge);
    const double now = pose_graph_chi2(graph);
    if (now - chi2 > std::max(when.least, when.share * chi2)) {
      chi2 = PoseGraphOptimizer<TypeParam>(options).optimize(graph).chi2_after;
    }
    EXPECT_NEAR(pose_graph_chi2(this->growing_.graph()), pose_graph_chi2(graph), 1e-6 * (1.0 + now))
        << "vertex " << k;
  }
}

TYPED_TEST(IncrementalPoseGraphTest, IsTheSameToTheBitInEveryRun) {
  IncrementalPoseGraph<TypeParam> again;
  for (int k = 0; k < this->kVertices; ++k) {
    this->add(k);
    again.add(k, this->whole_.pose(k), this->edges_of(k));
    const auto& T = this->growing_.graph().pose(k);
    EXPECT_EQ(T.inverse().p, again.graph().pose(k).inverse().p);
  }
  EXPECT_EQ(pose_graph_chi2(this->growing_.graph()), pose_graph_chi2(again.graph()));
}

TYPED_TEST(IncrementalPoseGraphTest, APartThatIsJoinedLaterEndsAtTheOptimum) {
  // What leads to vertex 60 comes with the last vertex, so that there are two parts until then.
  const auto is_joint = [](const auto& edge) { return std::max(edge.from, edge.to) == 60; };
  typename TestFixture::Edges kept_back;
  for (int k = 0; k < this->kVertices; ++k) {
    typename TestFixture::Edges edges;
    for (const auto& edge : this->edges_of(k)) {
      const bool joins = is_joint(edge) || (k > 60 && std::min(edge.from, edge.to) < 60);
      (joins ? kept_back : edges).push_back(edge);
    }
    if (k == this->kVertices - 1) edges.insert(edges.end(), kept_back.begin(), kept_back.end());
    this->growing_.add(k, this->whole_.pose(k), edges);
  }
  this->growing_.finish();
  PoseGraph<TypeParam> at_once = this->whole_;
  const double best = PoseGraphOptimizer<TypeParam>().optimize(at_once).chi2_after;
  EXPECT_NEAR(pose_graph_chi2(this->growing_.graph()), best, 1e-5 * best);
}

TYPED_TEST(IncrementalPoseGraphTest, NoOptimisationRaisesTheCost) {
  this->whole_ = grid_graph<TypeParam>(10, this->kVertices / 10, 0.6, 3);  // steps overshoot
  double chi2 = 0.0;
  for (int k = 0; k < this->kVertices; ++k) {
    PoseGraph<TypeParam> graph = this->growing_.graph();
    const auto edges = this->edges_of(k);
    graph.add_vertex(k,
                     k == 0 ? this->whole_.pose(0) : graph.pose(k - 1) * edges.front().T_from_to);
    for (const auto& edge : edges) graph.add_edge(edge);
    const double most = pose_graph_chi2(graph);
    this->add(k);
    chi2 = pose_graph_chi2(this->growing_.graph());
    EXPECT_LE(chi2, most * (1.0 + 1e-9) + 1e-9) << "vertex " << k;
  }
}

TYPED_TEST(IncrementalPoseGraphTest, ASystemThatIsExtendedIsTheOneThatIsLoaded) {
  PoseGraph<TypeParam> graph;
  PoseSystem<TypeParam> extended;
  for (int k = 0; k < this->kVertices; ++k) {
    graph.add_vertex(k, this->whole_.pose(k));
    if (k != 40) {  // from vertex 40 to 60 there are two parts
      for (const auto& edge : this->edges_of(k)) {
        if (k <= 40 || k >= 60 || edge.from >= 40) graph.add_edge(edge);
      }
    }
    if (k == 100) graph.set_fixed(k, true);
    if (k % 4 != 0) continue;
    extended.extend(graph);
    PoseSystem<TypeParam> loaded;
    loaded.load(graph);
    ASSERT_EQ(extended.unknowns(), loaded.unknowns()) << "vertex " << k;
    ASSERT_EQ(extended.pairs(), loaded.pairs()) << "vertex " << k;
    BlockMatrix<TypeParam::Tangent::RowsAtCompileTime> H, H_loaded;
    Eigen::VectorXd g, g_loaded;
    extended.linearize(extended.poses, H, g);
    loaded.linearize(loaded.poses, H_loaded, g_loaded);
    EXPECT_EQ(H.diagonal, H_loaded.diagonal) << "vertex " << k;
    EXPECT_EQ(H.pairs, H_loaded.pairs) << "vertex " << k;
    EXPECT_EQ(g, g_loaded) << "vertex " << k;
    EXPECT_EQ(extended.cost(extended.poses).chi2, loaded.cost(loaded.poses).chi2);
  }
}

TYPED_TEST(IncrementalPoseGraphTest, OneVertexAloneIsAtItsOptimum) {
  this->add(0);
  this->growing_.finish();
  EXPECT_EQ(this->growing_.graph().vertices().size(), 1U);
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
