// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/pose_graph_optimizer.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstring>

#include "pose_graph/dense_kernels.h"
#include "pose_graph/random_graphs.h"
#include "trident_base/error.h"

namespace trident::slam {
namespace {

template <class Group>
class PoseGraphOptimizerTest : public testing::Test {};
using OptimizerGroups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(PoseGraphOptimizerTest, OptimizerGroups);

template <class Group>
double largest_error(const PoseGraph<Group>& graph, const std::vector<Group>& truth) {
  double worst = 0.0;
  for (const auto& vertex : graph.vertices()) {
    worst = std::max(worst, (truth[vertex.id].inverse() * vertex.T_map_vertex).log().norm());
  }
  return worst;
}

template <class Group>
PoseGraphReport optimize(PoseGraph<Group>& graph, const PoseGraphOptions& options = {}) {
  return PoseGraphOptimizer<Group>(options).optimize(graph);
}

TYPED_TEST(PoseGraphOptimizerTest, FindsTheTruthOfExactMeasurements) {
  std::vector<TypeParam> truth;
  PoseGraph<TypeParam> graph = grid_graph<TypeParam>(6, 7, 0.0, 1, &truth);
  Dice dice(2);
  for (int id = 1; id < 42; ++id) {
    const auto off = dice.vector<typename TypeParam::Tangent>(0.2);
    graph.set_pose(id, graph.pose(id) * TypeParam::exp(off));
  }
  const PoseGraphReport report = optimize(graph);
  EXPECT_TRUE(report.has_converged);
  EXPECT_LT(report.chi2_after, 1e-12);
  EXPECT_LT(largest_error(graph, truth), 1e-7);
}

TYPED_TEST(PoseGraphOptimizerTest, EveryStrategyFindsTheSameMinimum) {
  const PoseGraph<TypeParam> start = grid_graph<TypeParam>(8, 8, 0.05, 3);
  std::vector<double> chi2;
  for (const auto strategy :
       {TrustStrategy::kGaussNewton, TrustStrategy::kLevenbergMarquardt, TrustStrategy::kDogleg}) {
    PoseGraph<TypeParam> graph = start;
    PoseGraphOptions options;
    options.strategy = strategy;
    options.relative_tolerance = 1e-10;
    const PoseGraphReport report = optimize(graph, options);
    EXPECT_TRUE(report.has_converged);
    EXPECT_LT(report.chi2_after, report.chi2_before);
    EXPECT_NEAR(report.chi2_after, pose_graph_chi2(graph), 1e-9 * report.chi2_after);
    chi2.push_back(report.chi2_after);
  }
  EXPECT_NEAR(chi2[1], chi2[0], 1e-6 * chi2[0]);
  EXPECT_NEAR(chi2[2], chi2[0], 1e-6 * chi2[0]);
}

TYPED_TEST(PoseGraphOptimizerTest, ChordalStartNeedsNoPoses) {
  PoseGraph<TypeParam> graph = grid_graph<TypeParam>(10, 10, 0.05, 4);
  PoseGraph<TypeParam> lost = graph;
  Dice dice(5);
  for (int id = 1; id < 100; ++id) {
    lost.set_pose(id, TypeParam::exp(dice.vector<typename TypeParam::Tangent>(3.0)));
  }
  PoseGraphOptions options;
  options.start = PoseGraphStart::kAuto;
  const double best = optimize(graph, options).chi2_after;
  const PoseGraphReport report = optimize(lost, options);
  EXPECT_TRUE(report.is_start_chordal);
  EXPECT_NEAR(report.chi2_after, best, 1e-5 * best);
}

TYPED_TEST(PoseGraphOptimizerTest, AutomaticStartKeepsGoodPoses) {
  PoseGraph<TypeParam> graph = grid_graph<TypeParam>(8, 8, 0.05, 6);
  optimize(graph);
  PoseGraphOptions options;
  options.start = PoseGraphStart::kAuto;
  const PoseGraphReport again = optimize(graph, options);
  EXPECT_FALSE(again.is_start_chordal);
  EXPECT_EQ(again.chi2_start, again.chi2_before);
  EXPECT_LE(again.iterations, 2);
}

TYPED_TEST(PoseGraphOptimizerTest, FixedVerticesStayAndPartsAreHeldByTheirFirst) {
  PoseGraph<TypeParam> graph = grid_graph<TypeParam>(5, 5, 0.05, 7);
  graph.set_fixed(13, true);
  typename TypeParam::Tangent away = TypeParam::Tangent::Ones();
  graph.add_vertex(100, TypeParam::exp(away));  // an island of two
  graph.add_vertex(101, TypeParam::identity());
  typename PoseGraph<TypeParam>::Edge edge;
  edge.from = 101;
  edge.to = 100;
  graph.add_edge(edge);
  const TypeParam fixed = graph.pose(13);
  EXPECT_TRUE(optimize(graph).has_converged);
  EXPECT_LT((fixed.inverse() * graph.pose(13)).log().norm(), 1e-15);
  EXPECT_LT((graph.pose(100).log() - away).norm(), 1e-12);
  EXPECT_LT((graph.pose(101).log() - away).norm(), 1e-6);
}

TYPED_TEST(PoseGraphOptimizerTest, IsRepeatableToTheBit) {
  PoseGraph<TypeParam> one = grid_graph<TypeParam>(9, 9, 0.1, 8);
  PoseGraph<TypeParam> two = one;
  PoseGraphOptimizer<TypeParam> reused;
  PoseGraph<TypeParam> other = grid_graph<TypeParam>(4, 9, 0.1, 9);
  reused.optimize(other);
  optimize(one);
  reused.optimize(two);
  for (int id = 0; id < 81; ++id) {
    const auto a = one.pose(id).log();
    const auto b = two.pose(id).log();
    EXPECT_EQ(0, std::memcmp(a.data(), b.data(), sizeof(a)));
  }
}

TYPED_TEST(PoseGraphOptimizerTest, IsTheSameOnLesserProcessors) {
  PoseGraph<TypeParam> one = grid_graph<TypeParam>(12, 12, 0.1, 8);
  PoseGraph<TypeParam> two = one;
  PoseGraphOptions options;
  options.start = PoseGraphStart::kChordal;
  optimize(one, options);
  force_plain_kernels(true);
  optimize(two, options);
  force_plain_kernels(false);
  for (int id = 0; id < 144; ++id) {
    const auto a = one.pose(id).log();
    const auto b = two.pose(id).log();
    EXPECT_EQ(0, std::memcmp(a.data(), b.data(), sizeof(a)));
  }
}

TYPED_TEST(PoseGraphOptimizerTest, GrowsWithTheGraph) {
  PoseGraph<TypeParam> graph = grid_graph<TypeParam>(6, 6, 0.05, 10);
  PoseGraphOptimizer<TypeParam> optimizer;
  optimizer.optimize(graph);
  typename PoseGraph<TypeParam>::Edge edge;
  edge.from = 35;
  edge.to = 36;
  graph.add_vertex(36, graph.pose(35));
  graph.add_edge(edge);
  EXPECT_TRUE(optimizer.optimize(graph).has_converged);
  graph.remove_vertex(20);
  EXPECT_FALSE(graph.has_vertex(20));
  EXPECT_TRUE(optimizer.optimize(graph).has_converged);
  EXPECT_NEAR((graph.pose(35).inverse() * graph.pose(36)).log().norm(), 0.0, 1e-9);
}

// The whole inverse of a numerical Hessian says the same.
TYPED_TEST(PoseGraphOptimizerTest, CovarianceIsThatOfTheDenseInverse) {
  PoseGraph<TypeParam> graph = grid_graph<TypeParam>(3, 4, 0.02, 11);
  using Tangent = typename TypeParam::Tangent;
  constexpr int kDimension = Tangent::RowsAtCompileTime;
  PoseGraphOptimizer<TypeParam> optimizer;
  optimizer.optimize(graph);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(11 * kDimension, 11 * kDimension);
  for (const auto& edge : graph.edges()) {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(kDimension, 12 * kDimension);
    for (const int id : {edge.from, edge.to}) {
      for (int axis = 0; axis < kDimension; ++axis) {
        const Tangent step = 1e-5 * Tangent::Unit(axis);
        const auto error = [&](const TypeParam& moved) {
          const TypeParam& from = id == edge.from ? moved : graph.pose(edge.from);
          const TypeParam& to = id == edge.to ? moved : graph.pose(edge.to);
          return pose_graph_error(from, to, edge.T_from_to);
        };
        const TypeParam& T = graph.pose(id);
        J.col(kDimension * id + axis) =
            (error(T * TypeParam::exp(step)) - error(T * TypeParam::exp(-step))) / 2e-5;
      }
    }
    const Eigen::MatrixXd free = J.rightCols(11 * kDimension);  // vertex 0 is held
    H += free.transpose() * edge.information * free;
  }
  const Eigen::MatrixXd inverse = H.inverse();
  const auto block = [&](int i, int j) -> Eigen::MatrixXd {
    return inverse.block((i - 1) * kDimension, (j - 1) * kDimension, kDimension, kDimension);
  };
  const auto marginal = optimizer.marginal_covariance(graph, 7);
  EXPECT_LT((marginal - block(7, 7)).norm(), 1e-5 * marginal.norm());
  const Eigen::MatrixXd A = -(graph.pose(10).inverse() * graph.pose(4)).adjoint();
  const Eigen::MatrixXd relative = block(10, 10) + A * block(4, 4) * A.transpose() +
                                   A * block(4, 10) + block(10, 4) * A.transpose();
  EXPECT_LT((optimizer.relative_covariance(graph, 4, 10) - relative).norm(),
            1e-5 * relative.norm());
  EXPECT_EQ(optimizer.marginal_covariance(graph, 0).norm(), 0.0);
}

TYPED_TEST(PoseGraphOptimizerTest, SurvivesFalseLoops) {
  const PoseGraph<TypeParam> clean = grid_graph<TypeParam>(10, 10, 0.02, 12);
  PoseGraph<TypeParam> best = clean;
  optimize(best);
  PoseGraph<TypeParam> spoilt = clean;
  Dice dice(13);
  typename PoseGraph<TypeParam>::Edge edge = clean.edges().back();
  const std::size_t true_edges = clean.edges().size();
  for (int k = 0; k < 25; ++k) {  // among 81 true ones
    edge.from = dice.roll(99);
    edge.to = edge.from + 1 + dice.roll(99 - edge.from);
    edge.T_from_to = TypeParam::exp(dice.vector<typename TypeParam::Tangent>(2.0));
    spoilt.add_edge(edge);
  }
  PoseGraph<TypeParam> naive = spoilt;
  optimize(naive);
  PoseGraphOptions options;
  options.is_graduated = true;
  options.start = PoseGraphStart::kAuto;
  const PoseGraphReport report = optimize(spoilt, options);
  double worst = 0.0;
  double worst_naive = 0.0;
  for (int id = 0; id < 100; ++id) {
    worst = std::max(worst, (best.pose(id).inverse() * spoilt.pose(id)).log().norm());
    worst_naive = std::max(worst_naive, (best.pose(id).inverse() * naive.pose(id)).log().norm());
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(worst_naive, 1.0);
  for (std::size_t k = 0; k < report.weights.size(); ++k) {
    EXPECT_EQ(report.weights[k], k < true_edges ? 1.0 : 0.0) << k;
  }
}

TEST(RobustKernel, WeightIsTheDerivativeOfTheCost) {
  for (const auto* name : {"none", "huber", "cauchy", "dcs", "geman_mcclure"}) {
    const RobustKernel kernel = robust_kernel_from_name(name);
    EXPECT_EQ(robust_kernel_name(kernel), name);
    for (const double s : {0.1, 1.0, 3.9, 4.1, 50.0, 1e4}) {
      const double step = 1e-5 * s;
      const double slope = (evaluate_robust_kernel(kernel, 2.0, s + step).cost -
                            evaluate_robust_kernel(kernel, 2.0, s - step).cost) /
                           (2.0 * step);
      EXPECT_NEAR(evaluate_robust_kernel(kernel, 2.0, s).weight, slope, 1e-6) << name << s;
    }
  }
  EXPECT_THROW(robust_kernel_from_name("hubert"), Error);
}

TEST(PoseGraph, RefusesWhatIsWrong) {
  PoseGraph2d graph = grid_graph<SE2>(2, 2, 0.1, 1);
  EXPECT_THROW(graph.add_vertex(3, SE2::identity()), Error);
  EXPECT_THROW(graph.set_pose(1, SE2::from_xy_yaw(NAN, 0.0, 0.0)), Error);
  EXPECT_THROW(graph.pose(4), Error);
  const PoseGraph2d::Edge good = graph.edges().front();
  const auto refuses = [&](auto spoil) {
    PoseGraph2d::Edge edge = good;
    spoil(edge);
    EXPECT_THROW(graph.add_edge(edge), Error);
  };
  refuses([](auto& edge) { edge.to = 4; });
  refuses([](auto& edge) { edge.to = edge.from; });
  refuses([](auto& edge) { edge.information(0, 1) = 1.0; });
  refuses([](auto& edge) { edge.information(0, 0) = -1.0; });
  refuses([](auto& edge) { edge.T_from_to.p.x() = INFINITY; });
  refuses([](auto& edge) { edge.kernel_scale = 0.0; });
  PoseGraphOptions options;
  options.relative_tolerance = 0.0;
  EXPECT_THROW(PoseGraphOptimizer<SE2>{options}, Error);
}

}  // namespace
}  // namespace trident::slam
