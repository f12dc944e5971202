// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "filter/covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace trident::estimation {
namespace {
constexpr double kAsymmetry = 1e-9;
constexpr double kMinEigenvalue = 1e-15;  // of the largest
}  // namespace

std::string covariance_problem(const Eigen::MatrixXd& matrix, Eigen::Index size) {
  if (matrix.rows() != size || matrix.cols() != size) {
    return "covariance is " + std::to_string(matrix.rows()) + " x " +
           std::to_string(matrix.cols()) + ", legal is " + std::to_string(size) + " x " +
           std::to_string(size);
  }
  if (!matrix.allFinite()) return "covariance is not finite";
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!((matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= kAsymmetry * largest)) {
    return "covariance is not symmetric";
  }
  if (matrix.llt().info() != Eigen::Success) return "covariance is not positive definite";
  return "";
}

Eigen::MatrixXd positive_definite(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd symmetric = 0.5 * matrix + 0.5 * matrix.transpose();
  if (symmetric.llt().info() == Eigen::Success) return symmetric;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  const double least = std::max(kMinEigenvalue * largest, std::numeric_limits<double>::min());
  const Eigen::VectorXd raised = eigen.eigenvalues().cwiseMax(least);
  symmetric = eigen.eigenvectors() * raised.asDiagonal() * eigen.eigenvectors().transpose();
  return 0.5 * symmetric + 0.5 * symmetric.transpose();
}

}  // namespace trident::estimation
