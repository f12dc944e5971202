// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "pose_graph/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <set>

#include "pose_graph/dense_kernels.h"
#include "pose_graph/random_graphs.h"

namespace trident::slam {
namespace {

template <int kSize>
struct Problem {
  std::vector<std::pair<int, int>> pairs;
  BlockMatrix<kSize> blocks;
  Eigen::MatrixXd dense;
};

// Random blocks at random places, with a diagonal that makes the matrix positive definite.
template <int kSize>
Problem<kSize> random_problem(int size, int pair_count, unsigned seed) {
  Dice dice(seed);
  std::set<std::pair<int, int>> pairs;
  while (static_cast<int>(pairs.size()) < pair_count) {
    const int i = dice.roll(size);
    const int j = dice.roll(size);
    if (i != j && pairs.count({j, i}) == 0) pairs.emplace(i, j);
  }
  Problem<kSize> problem;
  problem.pairs.assign(pairs.begin(), pairs.end());
  problem.blocks.set_zero(size, pairs.size());
  problem.dense = Eigen::MatrixXd::Zero(kSize * size, kSize * size);
  using Block = Eigen::Matrix<double, kSize, kSize>;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = problem.pairs[k];
    for (double& value : problem.blocks.pairs[k].reshaped()) value = dice.roll();
    const Block& block = problem.blocks.pairs[k];
    problem.dense.block(kSize * i, kSize * j, kSize, kSize) = block;
    problem.dense.block(kSize * j, kSize * i, kSize, kSize) = block.transpose();
  }
  for (int i = 0; i < size; ++i) {
    const double most =
        0.1 + problem.dense.middleRows(kSize * i, kSize).cwiseAbs().rowwise().sum().maxCoeff();
    problem.blocks.diagonal[i] = most * Block::Identity();
    problem.dense.block(kSize * i, kSize * i, kSize, kSize) = most * Block::Identity();
  }
  return problem;
}

template <int kSize>
void check_against_dense(int size, int pair_count, unsigned seed) {
  const Problem<kSize> problem = random_problem<kSize>(size, pair_count, seed);
  const auto symbolic = std::make_shared<const BlockSymbolic>(size, problem.pairs);
  BlockCholesky<kSize> cholesky(symbolic);
  ASSERT_TRUE(cholesky.factorize(problem.blocks));
  Dice dice(seed + 1);
  Eigen::VectorXd b(kSize * size);
  for (double& value : b) value = dice.roll();
  Eigen::VectorXd x = b;
  cholesky.solve(x);
  EXPECT_LT((problem.dense * x - b).cwiseAbs().maxCoeff(),
            1e-12 * problem.dense.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd inverse = problem.dense.inverse();
  const int i = dice.roll(size);
  const int j = dice.roll(size);
  const auto half_i = cholesky.half_solve(i);
  const auto half_j = cholesky.half_solve(j);
  const Eigen::MatrixXd block = half_i.transpose() * half_j;
  EXPECT_LT((block - inverse.block(kSize * i, kSize * j, kSize, kSize)).norm(),
            1e-10 * inverse.norm());
}

TEST(BlockCholesky, AgreesWithADenseOne) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const int size = 2 + static_cast<int>(seed) * 5;
    const int pairs = static_cast<int>(seed) % 4 * size / 2;
    const int possible = size * (size - 1) / 2;
    check_against_dense<2>(size, std::min(pairs, possible), seed);
    check_against_dense<3>(size, std::min(pairs, possible), seed);
    check_against_dense<6>(size, std::min(pairs, possible), seed);
  }
}

TEST(BlockCholesky, WorksOnOneVariable) { check_against_dense<3>(1, 0, 7); }

TEST(BlockCholesky, RefusesWhatIsNotPositiveDefinite) {
  Problem<3> problem = random_problem<3>(20, 30, 3);
  problem.blocks.diagonal[11](1, 1) = -1.0;
  BlockCholesky<3> cholesky(std::make_shared<const BlockSymbolic>(20, problem.pairs));
  EXPECT_FALSE(cholesky.factorize(problem.blocks));
}

TEST(DenseKernels, PanelIsTheCholeskyFactorForAnySize) {
  Dice dice(5);
  for (const int rows : {3, 6, 9, 51, 120}) {
    for (const int columns : {3, 48, 51, 96}) {
      if (columns > rows) continue;
      Eigen::MatrixXd A(rows, rows);
      for (double& value : A.reshaped()) value = dice.roll();
      A = (A * A.transpose() + Eigen::MatrixXd::Identity(rows, rows)).eval();
      const Eigen::MatrixXd L = A.llt().matrixL();
      const std::ptrdiff_t ld = padded_rows(rows);
      std::vector<double> panel(ld * columns, 0.0);
      Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> view(panel.data(), rows, columns,
                                                                Eigen::OuterStride<>(ld));
      view = A.leftCols(columns);
      ASSERT_TRUE(factorize_panel(panel.data(), ld, rows, columns, 3));
      for (int c = 0; c < columns; ++c) {
        EXPECT_NEAR(view(c, c), 1.0 / L(c, c), 1e-10);
        for (int r = c + 1; r < rows; ++r) EXPECT_NEAR(view(r, c), L(r, c), 1e-10);
      }
    }
  }
}

}  // namespace
}  // namespace trident::slam
