// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trident::estimation {

/// Degrees of freedom that follow one another in a state.
struct DofRange {
  Eigen::Index first = 0;  ///< of them
  Eigen::Index size = 0;   ///< how many
};

/// How a state changes by itself. The state x may be on a manifold (angles, rotations): then it has
/// more numbers than degrees of freedom, and only boxplus() and boxminus() know how it wraps
/// (Hertzberg et al., "Integrating generic sensor fusion algorithms with sound state
/// representations through encapsulation of manifolds", 2013). Pure: equal arguments, equal bits.
class Model {
 public:
  virtual ~Model() = default;

  /// Degrees of freedom, which are the rows of a covariance.
  virtual int dim() const = 0;

  /// The state `dt` [s] later, under the input `u` (may be empty).
  virtual Eigen::VectorXd predict(const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                                  double dt) const = 0;

  /// dim() x dim(): by how much predict() moves, in boxminus(), when x moves, in boxplus(). The
  /// default takes central differences.
  virtual Eigen::MatrixXd jacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                                   double dt) const;

  /// dim() x dim(): covariance that `dt` [s] add, positive semidefinite.
  virtual Eigen::MatrixXd noise(const Eigen::VectorXd& x, double dt) const = 0;

  /// Groups that move without regard to one another, and whose noise is independent: together all
  /// degrees of freedom, in their order. A filter needs the less time the smaller they are.
  virtual std::vector<DofRange> groups() const { return {{0, dim()}}; }

  /// x moved by d, of dim() numbers. The default is for vector spaces.
  virtual Eigen::VectorXd boxplus(const Eigen::VectorXd& x, const Eigen::VectorXd& d) const {
    return x + d;
  }

  /// What moves b to a: boxplus(b, boxminus(a, b)) is a.
  virtual Eigen::VectorXd boxminus(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    return a - b;
  }
};

}  // namespace trident::estimation
