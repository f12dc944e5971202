// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "joint_compatibility.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace trident::slam {
namespace {

/// The chosen pairs with the Cholesky factor of their joint innovation covariance; a pair more is
/// one row block more. `whitened` = L^-1 innovation, so the distance is its squared norm.
class JointSet {
 public:
  JointSet(std::size_t capacity, const InnovationCovariance& covariance)
      : covariance_(covariance),
        L_(Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(capacity),
                                 2 * static_cast<Eigen::Index>(capacity))),
        whitened_(Eigen::VectorXd::Zero(L_.rows())) {}

  const std::vector<LandmarkPair>& pairs() const { return pairs_; }
  std::size_t size() const { return pairs_.size(); }
  double distance2() const { return whitened_.head(rows()).squaredNorm(); }
  bool has(std::size_t landmark) const {
    return std::any_of(pairs_.begin(), pairs_.end(),
                       [&](const LandmarkPair& p) { return p.landmark == landmark; });
  }

  /// False (and no pair more) where the joint covariance is not positive definite.
  bool push(const LandmarkPair& pair) {
    const Eigen::Index n = rows();
    Eigen::MatrixXd cross(n, 2);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      cross.middleRows<2>(2 * static_cast<Eigen::Index>(i)) = covariance_(pairs_[i], pair);
    }
    L_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(cross);
    const Eigen::LLT<Eigen::Matrix2d> corner(
        Eigen::Matrix2d(covariance_(pair, pair) - cross.transpose() * cross));
    if (corner.info() != Eigen::Success) return false;
    L_.block(n, 0, 2, n) = cross.transpose();
    L_.block<2, 2>(n, n) = corner.matrixL();
    const Eigen::Vector2d rest = pair.innovation - cross.transpose() * whitened_.head(n);
    whitened_.segment<2>(n) = corner.matrixL().solve(rest);
    pairs_.push_back(pair);
    return true;
  }
  void pop() { pairs_.pop_back(); }

 private:
  Eigen::Index rows() const { return 2 * static_cast<Eigen::Index>(pairs_.size()); }

  const InnovationCovariance& covariance_;
  Eigen::MatrixXd L_;
  Eigen::VectorXd whitened_;
  std::vector<LandmarkPair> pairs_;
};

class Search {
 public:
  Search(const std::vector<std::vector<LandmarkPair>>& candidates, const std::vector<double>& gates,
         const InnovationCovariance& covariance, int budget)
      : candidates_(candidates),
        gates_(gates),
        set_(std::min(candidates.size(), gates.size() - 1), covariance),
        budget_(budget),
        pairable_after_(candidates.size() + 1, 0) {
    for (std::size_t i = candidates.size(); i-- > 0;) {
      pairable_after_[i] = pairable_after_[i + 1] + (candidates[i].empty() ? 0 : 1);
    }
  }

  std::vector<LandmarkPair> run() {
    visit(0);
    return best_;
  }

 private:
  bool is_better() const {
    return set_.size() > best_.size() ||
           (set_.size() == best_.size() && set_.distance2() < best_distance2_);
  }

  void visit(std::size_t observation) {
    if (is_better()) {
      best_ = set_.pairs();
      best_distance2_ = set_.distance2();
    }
    if (observation == candidates_.size() || set_.size() + 1 == gates_.size()) return;
    for (const LandmarkPair& candidate : candidates_[observation]) {
      if (set_.has(candidate.landmark)) continue;
      if (budget_-- <= 0) return;
      if (!set_.push(candidate)) continue;
      if (set_.distance2() <= gates_[set_.size()] && can_win(observation + 1)) {
        visit(observation + 1);
      }
      set_.pop();
    }
    if (can_win(observation + 1)) visit(observation + 1);  // without this observation
  }

  /// Can what is left still give a set as large as the best?
  bool can_win(std::size_t observation) const {
    const std::size_t most = set_.size() + pairable_after_[observation];
    return most > best_.size() || (most == best_.size() && set_.distance2() < best_distance2_);
  }

  const std::vector<std::vector<LandmarkPair>>& candidates_;
  const std::vector<double>& gates_;
  JointSet set_;
  int budget_;
  std::vector<std::size_t> pairable_after_;  ///< observations from i on that have a candidate
  std::vector<LandmarkPair> best_;
  double best_distance2_ = 0.0;
};

}  // namespace

std::vector<LandmarkPair> largest_joint_set(
    const std::vector<std::vector<LandmarkPair>>& candidates, const std::vector<double>& gates,
    const InnovationCovariance& covariance, int max_pairings) {
  return Search(candidates, gates, covariance, max_pairings).run();
}

}  // namespace trident::slam
