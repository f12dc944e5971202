// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "filter/intersection.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace trident::estimation {
namespace {

constexpr int kHalvings = 60;
constexpr double kMinGain = 1e-9;  // of the information, below which nothing is gained

// Slope of log det P'^-1 over w, where `ratios` are the eigenvalues of the measurement's
// information relative to the belief's: det P'^-1 / det P^-1 = product of w + (1 - w) ratio.
double slope(const Eigen::VectorXd& ratios, double w) {
  return ((1.0 - ratios.array()) / (w + (1.0 - w) * ratios.array())).sum();
}

// log det P'^-1 is concave in w: the root of its slope is found by halving.
double best_weight(const Eigen::VectorXd& ratios) {
  double low = 1e-6, high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double w = 0.5 * (low + high);
    (slope(ratios, w) > 0.0 ? low : high) = w;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<Correction> intersect(const Eigen::MatrixXd& P, const Eigen::MatrixXd& H,
                                    const Eigen::MatrixXd& R, const Eigen::VectorXd& innovation) {
  const Eigen::MatrixXd root = P.llt().matrixL();
  const Eigen::MatrixXd H_root = H * root;
  const Eigen::MatrixXd information = H_root.transpose() * R.llt().solve(H_root);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd ratios = eigen.eigenvalues().cwiseMax(0.0);
  if (slope(ratios, 1.0) >= -kMinGain) return std::nullopt;
  const double w = best_weight(ratios);
  const Eigen::MatrixXd wider = P / w, noise = R / (1.0 - w);
  const Eigen::MatrixXd PHt = wider * H.transpose();
  const Eigen::MatrixXd S = H * PHt + noise;
  const Eigen::MatrixXd K = S.llt().solve(PHt.transpose()).transpose();
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(P.rows(), P.rows()) - K * H;
  return Correction{K * innovation, rest * wider * rest.transpose() + K * noise * K.transpose()};
}

}  // namespace trident::estimation
