// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pose_system.h"
#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// Minimises the cost of a PoseSystem from its poses on. One Gauss-Newton system after the other;
/// the strategy says what is done with a step that raises the cost:
/// - Gauss-Newton takes it all the same;
/// - Levenberg-Marquardt adds lambda * diag(H) and grows lambda (Nielsen 1999). It begins undamped;
/// - dogleg (Powell 1970) turns from the Gauss-Newton step towards the gradient, within an
/// ellipsoid
///   whose axes go by diag(H), and needs no factorisation for that.
template <class Group>
class StepSearch {
 public:
  StepSearch(const PoseGraphOptions& options, PoseSystem<Group>& system);

  /// True when it has converged.
  bool run();
  /// Linear systems solved, and shorter steps tried.
  int iterations() const { return iterations_; }
  /// Whether some step raised the cost: the steps left the region where the linearisation holds,
  /// and may have ended in a minimum that is not the lowest.
  bool has_rejected() const { return has_rejected_; }

 private:
  static constexpr int kDimension = PoseSystem<Group>::kDimension;
  enum class Outcome { kMoved, kConverged, kStuck };

  Outcome iterate();
  Outcome iterate_damped();
  Outcome iterate_dogleg();
  Outcome accept_worse();
  Outcome outcome_of(double promised) const;
  void relax_damping(double gain);
  void adapt_radius(double gain, double step_length);
  Eigen::VectorXd step_within_radius(double newton_length, Eigen::VectorXd* downhill) const;
  bool solve(double lambda);
  bool solve_somehow();
  double length(const Eigen::VectorXd& step) const;
  double curvature(const Eigen::VectorXd& step) const;
  Eigen::VectorXd dogleg_step(const Eigen::VectorXd& downhill) const;
  /// True when the step lowers the cost or does not change it; then it is taken.
  bool try_step(const Eigen::VectorXd& step);
  bool is_negligible(double promised) const;
  double promised_by(const Eigen::VectorXd& step) const;

  const PoseGraphOptions& options_;
  PoseSystem<Group>& system_;
  BlockCholesky<kDimension> cholesky_;
  BlockMatrix<kDimension> H_;
  BlockMatrix<kDimension> damped_;
  Eigen::VectorXd g_;
  Eigen::VectorXd newton_;  // the Gauss-Newton step
  typename PoseSystem<Group>::Poses trial_;
  double cost_ = 0.0;
  double lambda_ = 0.0;
  double growth_ = 2.0;
  double radius_ = -1.0;  // of the dogleg, < 0: not needed yet
  int iterations_ = 0;
  bool has_rejected_ = false;
};

extern template class StepSearch<SE2>;
extern template class StepSearch<SE3>;

}  // namespace trident::slam
