// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "filter/moments.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "filter/differences.h"

namespace trident::estimation {
namespace {

Eigen::VectorXd residual(const Measurement& measurement, const Eigen::VectorXd& z,
                         const Eigen::VectorXd& z_hat) {
  return measurement.residual ? measurement.residual(z, z_hat) : Eigen::VectorXd(z - z_hat);
}

// Sigma points other than the belief's state, and moments of what becomes of them. All is taken
// from what becomes of the state itself, the central point, whose weight of -1 / alpha^2 then
// appears nowhere: with n = dim(), e_i the moves from there and w = 1 / (2 alpha^2 (n + kappa)),
//   m = sum w e_i,  covariance = sum w e_i e_i' + (beta - alpha^2) m m',
// which is the scaled transform with its sums rearranged.
class Spread {
 public:
  Spread(const Belief& belief, const SigmaPoints& points) : points_(points) {
    const Eigen::Index n = belief.covariance.rows();
    const double scale = points.alpha * points.alpha * (static_cast<double>(n) + points.kappa);
    weight_ = 0.5 / scale;
    const Eigen::MatrixXd root =
        std::sqrt(scale) * Eigen::MatrixXd(belief.covariance.llt().matrixL());
    moves_.resize(n, 2 * n);
    moves_ << root, -root;
  }

  // One column per point: how far it is from the state.
  const Eigen::MatrixXd& moves() const { return moves_; }
  Eigen::VectorXd mean(const Eigen::MatrixXd& moves) const {
    return weight_ * moves.rowwise().sum();
  }
  Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
    const double central = points_.beta - points_.alpha * points_.alpha;
    return weight_ * a * b.transpose() + central * mean(a) * mean(b).transpose();
  }

 private:
  SigmaPoints points_;
  double weight_ = 0.0;
  Eigen::MatrixXd moves_;
};

}  // namespace

Belief predict_extended(const Model& model, const Belief& belief, const Eigen::VectorXd& u,
                        double dt) {
  const Eigen::MatrixXd F = model.jacobian(belief.state, u, dt);
  return {model.predict(belief.state, u, dt),
          F * belief.covariance * F.transpose() + model.noise(belief.state, dt)};
}

Belief predict_unscented(const Model& model, const Belief& belief, const SigmaPoints& points,
                         const Eigen::VectorXd& u, double dt) {
  const Spread spread(belief, points);
  const Eigen::VectorXd center = model.predict(belief.state, u, dt);
  Eigen::MatrixXd moved(belief.covariance.rows(), spread.moves().cols());
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    const Eigen::VectorXd x = model.boxplus(belief.state, spread.moves().col(i));
    moved.col(i) = model.boxminus(model.predict(x, u, dt), center);
  }
  return {model.boxplus(center, spread.mean(moved)),
          spread.product(moved, moved) + model.noise(belief.state, dt)};
}

Expectation expect_extended(const Model& model, const Belief& belief,
                            const Measurement& measurement) {
  const Eigen::VectorXd& x = belief.state;
  Expectation result;
  result.innovation = residual(measurement, measurement.z, measurement.h(x));
  result.H = measurement.H ? measurement.H(x)
                           : central_differences(model.dim(), [&](const Eigen::VectorXd& d) {
                               return residual(measurement, measurement.h(model.boxplus(x, d)),
                                               measurement.h(x));
                             });
  result.unexplained = measurement.R;
  result.S = result.H * belief.covariance * result.H.transpose() + measurement.R;
  return result;
}

Expectation expect_unscented(const Model& model, const Belief& belief, const SigmaPoints& points,
                             const Measurement& measurement) {
  const Spread spread(belief, points);
  const Eigen::VectorXd center = measurement.h(belief.state);
  Eigen::MatrixXd moved(center.size(), spread.moves().cols());
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    const Eigen::VectorXd x = model.boxplus(belief.state, spread.moves().col(i));
    moved.col(i) = residual(measurement, measurement.h(x), center);
  }
  Expectation result;
  result.innovation = residual(measurement, measurement.z, center) - spread.mean(moved);
  const Eigen::MatrixXd of_points = spread.product(moved, moved);
  const Eigen::MatrixXd across = spread.product(spread.moves(), moved);
  result.H = belief.covariance.llt().solve(across).transpose();
  result.unexplained = of_points - result.H * across + measurement.R;
  result.S = of_points + measurement.R;
  return result;
}

}  // namespace trident::estimation
