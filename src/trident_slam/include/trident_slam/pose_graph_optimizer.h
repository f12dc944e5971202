// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "trident_slam/pose_graph.h"

namespace trident::slam {

/// How steps are kept from leaving the region where the linearisation holds.
enum class TrustStrategy { kGaussNewton, kLevenbergMarquardt, kDogleg };

/// Where the optimisation starts.
enum class PoseGraphStart {
  kGraph,    ///< from the poses of the graph
  kChordal,  ///< from averaged rotations and the positions that follow from them
  kAuto,     ///< from whichever of these costs least
};

/// How PoseGraphOptimizer steps, starts and ends.
struct PoseGraphOptions {
  TrustStrategy strategy = TrustStrategy::kDogleg;  ///< how steps are kept where the cost falls
  PoseGraphStart start = PoseGraphStart::kGraph;    ///< see PoseGraphStart
  int max_iterations = 100;                         ///< >= 1
  /// Converged when a step promises less than this part of the cost, > 0.
  double relative_tolerance = 1e-6;
  /// ... or less than this, >= 0.
  double absolute_tolerance = 1e-10;
  /// Where the search from the graph's own poses took long or had steps that raised the cost, it
  /// may have ended in a minimum of its own: then averaged rotations are tried, too, and what ends
  /// lower stays.
  bool tries_both_starts = false;
  /// Graduated non-convexity (Yang et al. 2020, Geman-McClure) over the edges that are not trusted:
  /// finds those that agree with each other from a poor start; the others are rejected, their
  /// weight in the report is 0. The edges' own kernels do not count.
  bool is_graduated = false;
  /// [standard deviations] beyond which an edge is an outlier, > 0; 0: default_outlier_scale().
  double graduated_scale = 0.0;

  /// Throws Error naming field, value and range.
  void validate() const;
};

/// What one of a thousand edges exceeds whose errors are Gaussian and as their information says, in
/// the plane or in space [standard deviations].
template <class Group>
constexpr double default_outlier_scale() {
  return PoseGraph<Group>::kDimension == 3 ? 4.033 : 4.739;
}

/// What an optimization did to the graph.
struct PoseGraphReport {
  double chi2_before = 0.0;       ///< of the graph's poses, sum of e' Omega e without kernels
  double chi2_start = 0.0;        ///< after the start was chosen
  double chi2_after = 0.0;        ///< of the poses that the graph has now
  double cost_before = 0.0;       ///< with kernels
  double cost_after = 0.0;        ///< with kernels, of those poses
  int iterations = 0;             ///< linear systems solved, rejected steps included
  bool has_converged = false;     ///< false: the iterations ran out
  bool is_start_chordal = false;  ///< averaged rotations were the start that led here
  /// Where the search from the graph's own poses ended that was given up for one from averaged
  /// rotations; 0: none was.
  double chi2_given_up = 0.0;
  /// Of each edge at the end, in [0, 1]: 1 without a robust kernel, near 0 for an outlier.
  std::vector<double> weights;
};

/// A method that optimises a pose graph in place. Equal input gives equal output to the bit. May be
/// called again after the graph has changed.
template <class Group>
class PoseGraphSolver {
 public:
  PoseGraphSolver() = default;
  PoseGraphSolver(const PoseGraphSolver&) = delete;
  PoseGraphSolver& operator=(const PoseGraphSolver&) = delete;
  virtual ~PoseGraphSolver() = default;
  /// Moves the vertices that are not fixed. Edges, kernels and structure stay.
  virtual PoseGraphReport optimize(PoseGraph<Group>& graph) = 0;
};

/// Makes a solver of planar graphs that takes at most so many iterations.
using PoseGraphSolverMaker = std::function<std::unique_ptr<PoseGraphSolver<SE2>>(int)>;

/// Our own solver: Gauss-Newton systems with analytic Jacobians, factorised block by block
/// (multifrontal Cholesky, minimum degree ordering of the vertices). The ordering is kept while the
/// graph's structure is unchanged. One thread, no clock.
template <class Group>
class PoseGraphOptimizer : public PoseGraphSolver<Group> {
 public:
  using Covariance = typename PoseGraph<Group>::Information;

  /// Throws Error as PoseGraphOptions::validate() does.
  explicit PoseGraphOptimizer(const PoseGraphOptions& options = {});
  ~PoseGraphOptimizer() override;

  PoseGraphReport optimize(PoseGraph<Group>& graph) override;

  /// Covariance of the tangent d of T_map_vertex * exp(d), with the edges' kernels, relative to the
  /// fixed vertices (zero for one of them). Throws Error when the id is unknown.
  Covariance marginal_covariance(const PoseGraph<Group>& graph, int id);

  /// Covariance of the tangent d of T_from_to * exp(d), where T_from_to = T_map_from^-1 * T_map_to.
  Covariance relative_covariance(const PoseGraph<Group>& graph, int from, int to);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class PoseGraphOptimizer<SE2>;
extern template class PoseGraphOptimizer<SE3>;

}  // namespace trident::slam
