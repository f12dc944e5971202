// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/pose_graph_optimizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "chordal_start.h"
#include "pose_system.h"
#include "step_search.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

void require(bool is_legal, const std::string& field, double value, const std::string& range) {
  if (is_legal) return;
  throw Error("pose graph options: " + field + " is " + number_text(value) + ", but must be " +
              range);
}

}  // namespace

void PoseGraphOptions::validate() const {
  require(max_iterations >= 1, "max_iterations", max_iterations, ">= 1");
  require(relative_tolerance > 0.0 && relative_tolerance < 1.0, "relative_tolerance",
          relative_tolerance, "in (0, 1)");
  require(absolute_tolerance >= 0.0, "absolute_tolerance", absolute_tolerance, ">= 0");
  require(graduated_scale >= 0.0, "graduated_scale", graduated_scale, ">= 0");
}

template <class Group>
class PoseGraphOptimizer<Group>::Impl {
 public:
  using System = PoseSystem<Group>;
  static constexpr int kDimension = System::kDimension;

  explicit Impl(const PoseGraphOptions& options) : options_(options) {
    options_.validate();
    if (options_.graduated_scale == 0.0) options_.graduated_scale = default_outlier_scale<Group>();
  }

  PoseGraphReport optimize(PoseGraph<Group>& graph) {
    system_.load(graph);
    PoseGraphReport report;
    begin_report(system_, report);
    if (options_.is_graduated) set_gnc_mu(1.0);
    apply_start(system_, options_.start, report);
    if (options_.is_graduated) run_gnc(report);
    const auto start = system_.poses;
    const bool was_easy = search(options_, report);
    const bool has_another = options_.tries_both_starts && !options_.is_graduated;
    if (has_another && !was_easy && !report.is_start_chordal) try_averaged_rotations(start, report);
    end_report(system_, report);
    system_.store(graph);
    return report;
  }

  Covariance marginal(const PoseGraph<Group>& graph, int id) {
    const int unknown = factorize(graph, graph.index(id));
    if (unknown == -1) return Covariance::Zero();
    const auto half = cholesky_->half_solve(unknown);
    return half.transpose() * half;
  }

  Covariance relative(const PoseGraph<Group>& graph, int from, int to) {
    const std::size_t a = graph.index(from);
    const std::size_t b = graph.index(to);
    const int unknown_a = factorize(graph, a);
    const int unknown_b = system_.unknown(b);
    // A step d_a of T_a moves T_ab as the step -Ad(T_ab^-1) d_a of T_b does.
    using Columns = typename BlockCholesky<kDimension>::Columns;
    Columns half = Columns::Zero(kDimension * system_.unknowns(), kDimension);
    if (unknown_b != -1) half += cholesky_->half_solve(unknown_b);
    if (unknown_a != -1) {
      const auto T = system_.poses[a].inverse() * system_.poses[b];
      half -= cholesky_->half_solve(unknown_a) * EdgeModel<Group>::inverse_adjoint(T).transpose();
    }
    return half.transpose() * half;
  }

 private:
  // The index of the vertex's unknown, with H at the graph's poses factorised.
  int factorize(const PoseGraph<Group>& graph, std::size_t vertex) {
    system_.load(graph);
    system_.linearize(system_.poses, H_, g_);
    cholesky_ = std::make_unique<BlockCholesky<kDimension>>(system_.symbolic());
    if (!cholesky_->factorize(H_)) {
      throw Error("pose graph: the edges do not determine every vertex, so there is no covariance");
    }
    return system_.unknown(vertex);
  }

  // Gives edges that are not trusted the kernel of graduated non-convexity.
  void set_gnc_mu(double mu) {
    for (auto& edge : system_.edges()) {
      if (edge.is_trusted) continue;
      edge.kernel = RobustKernel::kGemanMcClure;
      edge.kernel_scale = options_.graduated_scale * std::sqrt(mu);
    }
  }

  // Straight from the start, and from a kernel so wide that the cost is nearly convex: whichever
  // ends lower. The first is right where the start is good and many loops are false, so that the
  // convex cost is theirs; the second where the start is bad.
  void run_gnc(PoseGraphReport& report) {
    const auto start = system_.poses;
    set_gnc_mu(1.0);
    search(options_, report);
    const auto direct = system_.poses;
    system_.poses = start;
    anneal(report);
    if (system_.cost(direct).robust < system_.cost(system_.poses).robust) system_.poses = direct;
    reject();
  }

  // From the wide kernel down to the true one.
  void anneal(PoseGraphReport& report) {
    constexpr double kFactor = 1.4;
    double worst = 0.0;
    for (const auto& edge : system_.edges()) {
      if (!edge.is_trusted) worst = std::max(worst, system_.squared_error(edge, system_.poses));
    }
    PoseGraphOptions options = options_;
    options.max_iterations = 2;
    const double scale2 = options_.graduated_scale * options_.graduated_scale;
    for (double mu = 2.0 * worst / scale2; mu > 1.0; mu /= kFactor) {
      set_gnc_mu(mu);
      search(options, report);
    }
    set_gnc_mu(1.0);
    search(options_, report);
  }

  // Of the edges that were in doubt, those within the scale count in full and the others not.
  void reject() {
    const double scale2 = options_.graduated_scale * options_.graduated_scale;
    for (auto& edge : system_.edges()) {
      if (edge.is_trusted) continue;
      edge.kernel = RobustKernel::kNone;
      edge.is_rejected = system_.squared_error(edge, system_.poses) > scale2;
    }
  }

  // True when it converged soon and no step raised the cost: so it is from a start in the basin of
  // the lowest minimum.
  bool search(const PoseGraphOptions& options, PoseGraphReport& report) {
    StepSearch<Group> step_search(options, system_);
    report.has_converged = step_search.run();
    report.iterations += step_search.iterations();
    constexpr int kSoon = 15;
    return report.has_converged && !step_search.has_rejected() && step_search.iterations() < kSoon;
  }

  void try_averaged_rotations(const typename System::Poses& start, PoseGraphReport& report) {
    const auto found = std::exchange(system_.poses, start);
    PoseGraphReport other = report;
    apply_start(system_, PoseGraphStart::kChordal, other);
    if (other.is_start_chordal) search(options_, other);
    const auto cost = system_.cost(found);
    if (!other.is_start_chordal || !(system_.cost(system_.poses).robust < cost.robust)) {
      system_.poses = found;
      return;
    }
    report = std::move(other);
    report.chi2_given_up = cost.chi2;
  }

  PoseGraphOptions options_;
  System system_;
  BlockMatrix<kDimension> H_;
  Eigen::VectorXd g_;
  std::unique_ptr<BlockCholesky<kDimension>> cholesky_;
};

template <class Group>
PoseGraphOptimizer<Group>::PoseGraphOptimizer(const PoseGraphOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}

template <class Group>
PoseGraphOptimizer<Group>::~PoseGraphOptimizer() = default;

template <class Group>
PoseGraphReport PoseGraphOptimizer<Group>::optimize(PoseGraph<Group>& graph) {
  return impl_->optimize(graph);
}

template <class Group>
typename PoseGraphOptimizer<Group>::Covariance PoseGraphOptimizer<Group>::marginal_covariance(
    const PoseGraph<Group>& graph, int id) {
  return impl_->marginal(graph, id);
}

template <class Group>
typename PoseGraphOptimizer<Group>::Covariance PoseGraphOptimizer<Group>::relative_covariance(
    const PoseGraph<Group>& graph, int from, int to) {
  return impl_->relative(graph, from, to);
}

template class PoseGraphOptimizer<SE2>;
template class PoseGraphOptimizer<SE3>;

}  // namespace trident::slam
