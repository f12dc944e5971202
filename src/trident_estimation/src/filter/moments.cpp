// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "filter/moments.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "filter/differences.h"

namespace trident::estimation {
namespace {

Eigen::VectorXd residual(const Measurement& measurement, const Eigen::VectorXd& z,
                         const Eigen::VectorXd& z_hat) {
  return measurement.residual ? measurement.residual(z, z_hat) : Eigen::VectorXd(z - z_hat);
}

// Moves of all degrees of freedom, from those of the ones that a measurement depends on.
Eigen::VectorXd spread_out(const Eigen::VectorXd& d, const Measurement& measurement,
                           Eigen::Index dim) {
  if (measurement.dofs.empty()) return d;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(dim);
  for (std::size_t i = 0; i < measurement.dofs.size(); ++i) {
    all(measurement.dofs[i]) = d(static_cast<Eigen::Index>(i));
  }
  return all;
}

// F P F' of a Jacobian that is made of the groups' blocks alone.
void carry(const std::vector<DofRange>& groups, const std::vector<Eigen::MatrixXd>& F,
           Eigen::MatrixXd& P) {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    auto rows = P.middleRows(groups[i].first, groups[i].size);
    rows = (F[i] * rows).eval();
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    auto columns = P.middleCols(groups[i].first, groups[i].size);
    columns = (columns * F[i].transpose()).eval();
  }
}

// Sigma points other than the belief's state, and moments of what becomes of them. All is taken
// from what becomes of the state itself, the central point, whose weight of -1 / alpha^2 then
// appears nowhere: with n degrees of freedom, e_i the moves from there and
// w = 1 / (2 alpha^2 (n + kappa)),
//   m = sum w e_i,  covariance = sum w e_i e_i' + (beta - alpha^2) m m',
// which is the scaled transform with its sums rearranged. A sum n + kappa that would not be above
// zero, for a kappa of a larger state, counts as n.
class Spread {
 public:
  Spread(const Eigen::MatrixXd& covariance, const SigmaPoints& points)
      : points_(points), factor_(covariance.llt()) {
    const Eigen::Index n = covariance.rows();
    const auto count = static_cast<double>(n);
    const double sum = count + points.kappa > 0.0 ? count + points.kappa : count;
    const double scale = points.alpha * points.alpha * sum;
    weight_ = 0.5 / scale;
    const Eigen::MatrixXd root = std::sqrt(scale) * Eigen::MatrixXd(factor_.matrixL());
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
  // The straight line that explains `moved` best by moves(): its slope.
  Eigen::MatrixXd slope(const Eigen::MatrixXd& across) const {
    return factor_.solve(across).transpose();
  }

 private:
  SigmaPoints points_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  double weight_ = 0.0;
  Eigen::MatrixXd moves_;
};

// Where the sigma points of all groups go, from where `center` is. As no group moves another, one
// call of the model moves a point of each.
Eigen::MatrixXd moved_points(const Model& model, const Eigen::VectorXd& state,
                             const Eigen::VectorXd& center, const std::vector<DofRange>& groups,
                             const std::vector<Spread>& spreads, const Eigen::VectorXd& u,
                             double dt) {
  Eigen::Index points = 0;
  for (const Spread& spread : spreads) points = std::max(points, spread.moves().cols());
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(model.dim(), points);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    moves.block(groups[i].first, 0, groups[i].size, spreads[i].moves().cols()) = spreads[i].moves();
  }
  for (Eigen::Index i = 0; i < points; ++i) {
    const Eigen::VectorXd x = model.boxplus(state, moves.col(i));
    moves.col(i) = model.boxminus(model.predict(x, u, dt), center);
  }
  return moves;
}

}  // namespace

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& covariance, const Measurement& measurement) {
  if (measurement.dofs.empty()) return covariance;
  Eigen::MatrixXd columns(covariance.rows(), static_cast<Eigen::Index>(measurement.dofs.size()));
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    columns.col(i) = covariance.col(measurement.dofs[static_cast<std::size_t>(i)]);
  }
  return columns;
}

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& columns, const Measurement& measurement) {
  if (measurement.dofs.empty()) return columns;
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(measurement.dofs.size()), columns.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = columns.row(measurement.dofs[static_cast<std::size_t>(i)]);
  }
  return rows;
}

Belief predict_extended(const Model& model, const Belief& belief, const Eigen::VectorXd& u,
                        double dt) {
  const Eigen::MatrixXd F = model.jacobian(belief.state, u, dt);
  const std::vector<DofRange> groups = model.groups();
  std::vector<Eigen::MatrixXd> blocks;
  blocks.reserve(groups.size());
  for (const DofRange& group : groups) {
    blocks.emplace_back(F.block(group.first, group.first, group.size, group.size));
  }
  Belief after{model.predict(belief.state, u, dt), belief.covariance};
  carry(groups, blocks, after.covariance);
  after.covariance += model.noise(belief.state, dt);
  return after;
}

Belief predict_unscented(const Model& model, const Belief& belief, const SigmaPoints& points,
                         const Eigen::VectorXd& u, double dt) {
  const std::vector<DofRange> groups = model.groups();
  const Eigen::VectorXd center = model.predict(belief.state, u, dt);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(model.dim());
  std::vector<Spread> spreads;
  for (const DofRange& group : groups) {
    const auto& P = belief.covariance;
    spreads.emplace_back(P.block(group.first, group.first, group.size, group.size), points);
  }
  const Eigen::MatrixXd all = moved_points(model, belief.state, center, groups, spreads, u, dt);
  std::vector<Eigen::MatrixXd> slopes, blocks;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Spread& spread = spreads[i];
    const Eigen::MatrixXd moved =
        all.block(groups[i].first, 0, groups[i].size, spread.moves().cols());
    mean.segment(groups[i].first, groups[i].size) = spread.mean(moved);
    blocks.push_back(spread.product(moved, moved));
    if (groups.size() > 1) slopes.push_back(spread.slope(spread.product(spread.moves(), moved)));
  }
  Belief after{model.boxplus(center, mean), belief.covariance};
  if (groups.size() > 1) carry(groups, slopes, after.covariance);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const DofRange& group = groups[i];
    after.covariance.block(group.first, group.first, group.size, group.size) = blocks[i];
  }
  after.covariance += model.noise(belief.state, dt);
  return after;
}

Expectation expect_extended(const Model& model, const Belief& belief,
                            const Eigen::MatrixXd& columns, const Measurement& measurement) {
  const Eigen::VectorXd& x = belief.state;
  Expectation result;
  const Eigen::VectorXd center = measurement.h(x);
  result.innovation = residual(measurement, measurement.z, center);
  result.H = measurement.H
                 ? measurement.H(x)
                 : central_differences(columns.cols(), [&](const Eigen::VectorXd& d) {
                     const Eigen::VectorXd all = spread_out(d, measurement, model.dim());
                     return residual(measurement, measurement.h(model.boxplus(x, all)), center);
                   });
  result.unexplained = Eigen::MatrixXd::Zero(center.size(), center.size());
  result.S = result.H * rows_of(columns, measurement) * result.H.transpose();
  return result;
}

Expectation expect_unscented(const Model& model, const Belief& belief,
                             const Eigen::MatrixXd& columns, const SigmaPoints& points,
                             const Measurement& measurement) {
  const Spread spread(rows_of(columns, measurement), points);
  const Eigen::VectorXd center = measurement.h(belief.state);
  Eigen::MatrixXd moved(center.size(), spread.moves().cols());
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    const Eigen::VectorXd d = spread_out(spread.moves().col(i), measurement, model.dim());
    moved.col(i) = residual(measurement, measurement.h(model.boxplus(belief.state, d)), center);
  }
  Expectation result;
  result.innovation = residual(measurement, measurement.z, center) - spread.mean(moved);
  const Eigen::MatrixXd across = spread.product(spread.moves(), moved);
  result.S = spread.product(moved, moved);
  result.H = spread.slope(across);
  result.unexplained = result.S - result.H * across;
  return result;
}

}  // namespace trident::estimation
