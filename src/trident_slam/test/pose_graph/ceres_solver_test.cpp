// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "graph_slam/polygon_world.h"
#include "pose_graph/random_graphs.h"
#include "trident_base/error.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/pose_graph_ceres.h"

namespace trident::slam {
namespace {

template <class Group>
class CeresSolverTest : public testing::Test {};
using Groups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(CeresSolverTest, Groups);

template <class Group>
double our_chi2(PoseGraph<Group> graph) {
  return PoseGraphOptimizer<Group>().optimize(graph).chi2_after;
}

TYPED_TEST(CeresSolverTest, EveryChoiceFindsOurMinimum) {
  const PoseGraph<TypeParam> start = grid_graph<TypeParam>(7, 7, 0.05, 1);
  const double chi2 = our_chi2(start);
  std::vector<CeresOptions> choices(6);
  choices[1].linear_solver = "SPARSE_SCHUR";
  choices[2].linear_solver = "ITERATIVE_SCHUR";
  choices[3].linear_solver = "CGNR";
  choices[4].trust_strategy = "DOGLEG";
  choices[5].trust_strategy = "DOGLEG";
  choices[5].dogleg_type = "SUBSPACE_DOGLEG";
  for (const CeresOptions& options : choices) {
    PoseGraph<TypeParam> graph = start;
    const PoseGraphReport report = make_ceres_solver<TypeParam>(options)->optimize(graph);
    EXPECT_TRUE(report.has_converged) << options.linear_solver;
    EXPECT_NEAR(report.chi2_after, chi2, 1e-3 * chi2) << options.linear_solver;
  }
}

TYPED_TEST(CeresSolverTest, KernelsMeanTheSame) {
  PoseGraph<TypeParam> graph = grid_graph<TypeParam>(6, 6, 0.05, 2);
  graph.set_pose(20, TypeParam::identity());
  for (std::size_t k = 0; k < graph.edges().size(); ++k) {
    graph.set_kernel(k, RobustKernel::kHuber, 0.7);
  }
  PoseGraph<TypeParam> ours = graph;
  const double cost = PoseGraphOptimizer<TypeParam>().optimize(ours).cost_after;
  const auto solver = make_ceres_solver<TypeParam>({});
  EXPECT_NEAR(solver->optimize(graph).cost_after, cost, 1e-3 * cost);
  CeresOptions options;
  options.loss_function = "HuberLoss";  // of edges without a kernel
  PoseGraph<TypeParam> plain = grid_graph<TypeParam>(6, 6, 0.05, 2);
  const auto by_loss = make_ceres_solver<TypeParam>(options);
  EXPECT_NEAR(by_loss->optimize(plain).cost_after, cost, 1e-3 * cost);
}

TEST(CeresOptions, NamesTheParameter) {
  CeresOptions options;
  options.linear_solver = "SPARSE_SHUR";
  try {
    options.validate();
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("ceres_linear_solver 'SPARSE_SHUR'; did you mean 'SPARSE_SCHUR'?"),
              std::string::npos)
        << text;
  }
}

// graph_slam_2d makes the same map with either solver.
TEST(CeresOptions, AMapMayBeOptimizedByCeres) {
  const PolygonWorld world = ring_world();
  const std::vector<SE2> path = ring_path(0.5);
  const std::vector<SE2> odometry = drifting_odometry(path, 1.05, 0.97);
  const PoseGraphSolverMaker ceres = [](int max_iterations) {
    CeresOptions options;
    options.max_iterations = max_iterations;
    return make_ceres_solver<SE2>(options);
  };
  GraphSlam2d with_ceres({}, ceres);
  GraphSlam2d with_ours;
  for (GraphSlam2d* slam : {&with_ceres, &with_ours}) {
    for (std::size_t i = 0; i < 120; ++i) slam->add_scan(world.scan(path[i], i), odometry[i]);
    slam->finish();
  }
  const auto poses = with_ceres.trajectory();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT((poses[i].T_map_base.p - with_ours.trajectory()[i].T_map_base.p).norm(), 0.01);
  }
}

}  // namespace
}  // namespace trident::slam
