// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "block_symbolic.h"

namespace trident::slam {

/// A symmetric matrix of square blocks: those of the diagonal, and for each pair (i, j) of its
/// structure the block in row i and column j.
template <int kSize>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, kSize, kSize>;
  std::vector<Block, Eigen::aligned_allocator<Block>> diagonal;
  std::vector<Block, Eigen::aligned_allocator<Block>> pairs;

  void set_zero(std::size_t variables, std::size_t pair_count) {
    diagonal.assign(variables, Block::Zero());
    pairs.assign(pair_count, Block::Zero());
  }
};

/// Multifrontal Cholesky factorisation (Duff, Reid 1983; Liu 1992) of a block matrix. Sums are
/// formed in an order that the structure alone decides.
template <int kSize>
class BlockCholesky {
 public:
  using Block = typename BlockMatrix<kSize>::Block;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, kSize>;

  BlockCholesky() = default;  ///< reset() comes next
  explicit BlockCholesky(std::shared_ptr<const BlockSymbolic> symbolic);
  /// From now on for this structure; memory is kept.
  void reset(std::shared_ptr<const BlockSymbolic> symbolic);

  /// False when the matrix is not positive definite; then nothing may be solved.
  bool factorize(const BlockMatrix<kSize>& matrix);

  /// Solves A x = b; `vector` holds b, then x, in the order of the variables.
  void solve(Eigen::VectorXd& vector);

  /// L^-1 P E, where E is the identity in the rows of that variable: products of two of these are
  /// blocks of the inverse of A.
  Columns half_solve(int variable);

 private:
  void assemble(std::size_t s, const BlockMatrix<kSize>& matrix);
  void add_child(std::size_t parent, std::size_t child);
  void forward(const BlockSymbolic::Supernode& node, const double* panel, double* x);
  void backward(const BlockSymbolic::Supernode& node, const double* panel, double* x);
  double* update_of(std::size_t s) { return updates_.data() + update_begin_[s]; }

  std::shared_ptr<const BlockSymbolic> symbolic_;
  std::vector<std::size_t> panel_begin_;   // of each supernode in panels_
  std::vector<std::size_t> update_begin_;  // of its update matrix, shared once no longer needed
  std::vector<double> panels_;
  std::vector<double> updates_;
  std::vector<double> below_;  // of the solution, what belongs to the rows below a panel
  std::vector<double> permuted_;
};

extern template class BlockCholesky<2>;
extern template class BlockCholesky<3>;
extern template class BlockCholesky<6>;

}  // namespace trident::slam
