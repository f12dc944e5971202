// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>

namespace trident::control {

/// Minimises 1/2 z'Hz - g'z within lo <= z <= hi by a primal active set: H is symmetric and
/// positive definite, 0 lies within the bounds. N bounds the number of variables, so that nothing
/// is allocated.
template <int N>
class BoxProgram {
 public:
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, N, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, N, N>;

  BoxProgram(const Matrix& H, const Vector& g, const Vector& lo, const Vector& hi)
      : H_(H), g_(g), lo_(lo), hi_(hi), z_(Vector::Zero(g.size())) {}

  Vector solve() {
    // Each turn binds or frees one variable; more than this is rounding that goes in circles.
    const int most_turns = 10 * static_cast<int>(g_.size()) + 10;
    for (int turn = 0; turn < most_turns; ++turn) {
      if (step_to_minimum()) continue;
      if (!free_one()) break;
    }
    return z_;
  }

 private:
  /// Towards the minimum over the free variables, as far as the bounds let it. Returns whether one
  /// was reached.
  bool step_to_minimum() {
    int count = 0;
    std::array<int, N> free{};
    for (int i = 0; i < g_.size(); ++i) {
      if (!is_bound_[static_cast<std::size_t>(i)]) free[static_cast<std::size_t>(count++)] = i;
    }
    if (count == 0) return false;
    Matrix H(count, count);
    Vector gradient(count);
    for (int a = 0; a < count; ++a) {
      const int i = free[static_cast<std::size_t>(a)];
      gradient[a] = g_[i] - H_.row(i).dot(z_);
      for (int b = 0; b < count; ++b) H(a, b) = H_(i, free[static_cast<std::size_t>(b)]);
    }
    const Vector step = H.llt().solve(gradient);
    double part = 1.0;
    int bound = -1;
    for (int a = 0; a < count; ++a) {
      const int i = free[static_cast<std::size_t>(a)];
      const double room = step[a] > 0.0 ? hi_[i] - z_[i] : lo_[i] - z_[i];
      if (step[a] == 0.0 || room / step[a] >= part) continue;
      part = room / step[a];
      bound = i;
    }
    for (int a = 0; a < count; ++a) z_[free[static_cast<std::size_t>(a)]] += part * step[a];
    if (bound < 0) return false;
    const auto m = static_cast<std::size_t>(bound);
    is_bound_[m] = true;
    at_upper_[m] = hi_[bound] - z_[bound] < z_[bound] - lo_[bound];
    z_[bound] = at_upper_[m] ? hi_[bound] : lo_[bound];
    return true;
  }

  /// Lets go of the bound that holds the most back. False: none does.
  bool free_one() {
    int worst = -1;
    double largest = 1e-10 * (1.0 + g_.template lpNorm<Eigen::Infinity>());
    for (int i = 0; i < g_.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!is_bound_[k] || lo_[i] == hi_[i]) continue;
      const double down = H_.row(i).dot(z_) - g_[i];  // the cost falls against it
      const double gain = at_upper_[k] ? down : -down;
      if (gain > largest) largest = gain, worst = i;
    }
    if (worst < 0) return false;
    is_bound_[static_cast<std::size_t>(worst)] = false;
    return true;
  }

  const Matrix& H_;
  const Vector &g_, &lo_, &hi_;
  Vector z_;
  std::array<bool, N> is_bound_{}, at_upper_{};
};

}  // namespace trident::control
