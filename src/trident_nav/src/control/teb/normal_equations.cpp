// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "normal_equations.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {

void NormalEquations::reset(std::size_t nodes) {
  cost_ = 0.0;
  gradient_.assign(nodes * kTebVariables, 0.0);
  // A quantity's row may reach beyond the band's last pose by slopes that are zero.
  rows_.assign(nodes * kTebVariables * kWidth, 0.0);
}

void NormalEquations::fix(std::size_t variable) {
  gradient_[variable] = 0.0;
  const std::size_t count = gradient_.size();
  double* const row = &rows_[variable * kWidth];
  std::fill(row, row + kWidth, 0.0);
  row[kWidth - 1] = 1.0;
  // Its column: the entries of later rows that are as far left of their diagonal.
  for (std::size_t k = 1; k < kWidth && variable + k < count; ++k) {
    rows_[(variable + k) * kWidth + kWidth - 1 - k] = 0.0;
  }
}

bool NormalEquations::decompose(double damping) {
  constexpr double kFloor = 1e-9;  // of diagonals: of variables that nothing depends on
  factor_ = rows_;
  const std::size_t count = gradient_.size();
  for (std::size_t i = 0; i < count; ++i) {
    double* const row = &factor_[i * kWidth];
    row[kWidth - 1] += damping * row[kWidth - 1] + kFloor;
    const std::size_t reach = std::min(i, kWidth - 1);
    for (std::size_t j = i - reach; j < i; ++j) {
      // Column j of row i, less what both rows have in common to the left of it.
      const double* const other = &factor_[j * kWidth];
      const std::size_t at = kWidth - 1 - (i - j);
      double sum = row[at];
      for (std::size_t k = 1; k <= at; ++k) sum -= row[at - k] * other[kWidth - 1 - k];
      row[at] = sum / other[kWidth - 1];
    }
    double pivot = row[kWidth - 1];
    for (std::size_t k = 0; k + 1 < kWidth; ++k) pivot -= row[k] * row[k];
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    row[kWidth - 1] = std::sqrt(pivot);
  }
  return true;
}

bool NormalEquations::solve(double damping, std::vector<double>* step) {
  if (!decompose(damping)) return false;
  const std::size_t count = gradient_.size();
  step->resize(count);
  std::vector<double>& x = *step;
  for (std::size_t i = 0; i < count; ++i) {
    const double* const row = &factor_[i * kWidth];
    double sum = -gradient_[i];
    for (std::size_t k = 1; k <= std::min(i, kWidth - 1); ++k)
      sum -= row[kWidth - 1 - k] * x[i - k];
    x[i] = sum / row[kWidth - 1];
  }
  for (std::size_t i = count; i-- > 0;) {
    const double* const row = &factor_[i * kWidth];
    x[i] /= row[kWidth - 1];
    for (std::size_t k = 1; k <= std::min(i, kWidth - 1); ++k)
      x[i - k] -= row[kWidth - 1 - k] * x[i];
  }
  return true;
}

}  // namespace trident::nav
