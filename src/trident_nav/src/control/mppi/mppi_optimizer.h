// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "control_plan.h"
#include "critics/critic.h"
#include "noise_table.h"
#include "obstacle_survey.h"
#include "trident_base/worker_pool.h"

namespace trident::nav {

/// A plan and what the critics say of it.
struct RatedPlan {
  ControlPlan plan;
  double cost = 0.0;
  int contact_step = 0;  ///< First step in contact; the number of steps: none.
};

/// One iteration of model predictive path integral control: samples about a plan, scores them, and
/// joins them by their weights. Williams, Drews, Goldfain, Rehg, Theodorou, "Information-theoretic
/// model predictive control", T-RO 34 (2018). As limits of speed and of acceleration hold in each
/// sample, they hold in the weighted mean. The mean of samples on two sides of an obstacle leads
/// into it: the mean is rated, too, and the best single sample is taken where that is better.
///
/// Blocks of trajectories are shared between threads; sums are formed in the order of the blocks,
/// so that the number of threads changes no bit.
class MppiOptimizer {
 public:
  MppiOptimizer(const MppiModel& model, const MppiParams& params, std::uint64_t seed, int threads);

  /// `deliberate` holds what the first block wants; see write_deliberate_samples().
  RatedPlan optimize(const ControlPlan& plan, const Rollouts& deliberate, const CriticScene& scene,
                     const RolloutStart& start, const ObstacleSurvey& survey);

  /// Notes samples of the last call and their costs: those of every so many as the visualizer says.
  void describe(const Pose2& start, const TrajectoryVisualizerParams& shown,
                std::vector<ConsideredTrajectory>* noted) const;

  /// The costs of the last call, and the noise for the next one.
  const std::vector<float>& costs() const { return costs_; }
  void advance_noise() { noise_.advance(); }
  void rewind_noise() { noise_.rewind(); }

 private:
  void sample(int block, const ControlPlan& plan, Rollouts* rollouts) const;
  void rate(const CriticScene& scene, const Rollouts& rollouts, float* costs) const;
  void add_smoothness(const Rollouts& rollouts, float* costs) const;
  void keep(int block, const Rollouts& rollouts);
  std::vector<float> weights() const;
  ControlPlan mean(const std::vector<float>& weights) const;
  ControlPlan kept_sample(std::size_t index) const;

  MppiModel model_;
  double temperature_, gamma_;
  std::vector<std::unique_ptr<MppiCritic>> critics_;
  NoiseTable noise_;
  WorkerPool pool_;
  std::vector<Rollouts> workers_;
  std::vector<float> costs_;
  std::vector<float> kept_[3];  ///< Controls, [block][step][lane].
};

}  // namespace trident::nav
