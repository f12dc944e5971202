// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace trident::nav {

/// Variables of a pose of a band, in this order: x, y, yaw, and the duration to the next pose.
constexpr std::size_t kTebVariables = 4;

/// A number that depends on the variables of `kNodes` poses in a row, and its slopes by them.
template <std::size_t kNodes>
struct TebQuantity {
  double value = 0.0;
  std::array<double, kTebVariables * kNodes> slopes{};
};

/// The normal equations H step = -g of a sum of weighted squares, whose terms depend on three poses
/// in a row at most: H is a band of blocks, kept as its lower half.
class NormalEquations {
 public:
  /// All zero, for so many poses.
  void reset(std::size_t nodes);

  /// Adds weight * quantity^2 to the cost; its first pose is `node`.
  template <std::size_t kNodes>
  void add(std::size_t node, const TebQuantity<kNodes>& quantity, double weight) {
    cost_ += weight * quantity.value * quantity.value;
    attract(node, quantity, weight);
  }

  /// Draws the step to where a quantity is zero, without a cost for it now.
  template <std::size_t kNodes>
  void attract(std::size_t node, const TebQuantity<kNodes>& quantity, double weight) {
    static_assert(kNodes <= kMaxNodes);
    const std::size_t first = node * kTebVariables;
    for (std::size_t i = 0; i < quantity.slopes.size(); ++i) {
      const double scaled = weight * quantity.slopes[i];
      if (scaled == 0.0) continue;
      gradient_[first + i] += scaled * quantity.value;
      double* const row = &rows_[(first + i) * kWidth + kWidth - 1 - i];
      for (std::size_t j = 0; j <= i; ++j) row[j] += scaled * quantity.slopes[j];
    }
  }

  /// Takes a variable out: its step will be zero.
  void fix(std::size_t variable);

  /// Solves (H + damping * diag(H)) step = -g by Cholesky's decomposition within the band. False:
  /// the matrix is not positive definite, as with values that are not finite.
  bool solve(double damping, std::vector<double>* step);

  double cost() const { return cost_; }
  std::size_t variables() const { return gradient_.size(); }
  const std::vector<double>& gradient() const { return gradient_; }

 private:
  static constexpr std::size_t kMaxNodes = 3;
  static constexpr std::size_t kWidth = kTebVariables * kMaxNodes;  ///< Diagonal included.

  bool decompose(double damping);

  double cost_ = 0.0;
  std::vector<double> gradient_;  ///< Half of the cost's.
  std::vector<double> rows_;      ///< Of each variable, kWidth entries that end at the diagonal.
  std::vector<double> factor_;    ///< Its Cholesky factor, in the same order.
};

}  // namespace trident::nav
