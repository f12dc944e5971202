// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mppi_optimizer.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

// Mean of one control over all samples, for each step; lanes are summed last.
void add_weighted(const float* values, const float* weights, int steps, float* sums) {
  run_lanes([&]() TRIDENT_LANES {
    for (int step = 0; step < steps; ++step) {
      for (int i = 0; i < kLanes; ++i) {
        sums[step * kLanes + i] += weights[i] * values[step * kLanes + i];
      }
    }
  });
}

double lane_sum(const float* values) {
  double sum = 0.0;
  for (int i = 0; i < kLanes; ++i) sum += static_cast<double>(values[i]);
  return sum;
}

void add_noise(const ControlPlan& plan, double Twist2::*axis, const float* noise, float sign,
               float* values) {
  std::vector<float> centers;
  for (const Twist2& twist : plan) centers.push_back(static_cast<float>(twist.*axis));
  const int steps = static_cast<int>(plan.size());
  run_lanes([&]() TRIDENT_LANES {
    for (int step = 0; step < steps; ++step) {
      for (int i = 0; i < kLanes; ++i) {
        const int k = step * kLanes + i;
        values[k] = centers[static_cast<std::size_t>(step)] + sign * noise[k];
      }
    }
  });
}

}  // namespace

MppiOptimizer::MppiOptimizer(const MppiModel& model, const MppiParams& params, std::uint64_t seed,
                             int threads)
    : model_(model),
      temperature_(params.temperature),
      gamma_(params.gamma),
      critics_(make_mppi_critics(params, model)),
      noise_(model, seed, params.regenerate_noises),
      pool_(static_cast<std::size_t>(threads)),
      workers_(static_cast<std::size_t>(threads), Rollouts(model.steps)) {
  const auto samples = static_cast<std::size_t>(model.blocks) * kLanes;
  costs_.assign(samples, 0.0F);
  for (auto& values : kept_) values.assign(samples * static_cast<std::size_t>(model.steps), 0.0F);
}

void MppiOptimizer::sample(int block, const ControlPlan& plan, Rollouts* rollouts) const {
  constexpr double Twist2::*kAxes[] = {&Twist2::vx, &Twist2::vy, &Twist2::wz};
  std::vector<float>* const values[] = {&rollouts->vx, &rollouts->vy, &rollouts->wz};
  for (const auto axis : {NoiseTable::kX, NoiseTable::kY, NoiseTable::kYaw}) {
    const float* noise = noise_.of(block, axis);
    if (noise == nullptr) {
      std::fill(values[axis]->begin(), values[axis]->end(), 0.0F);
    } else {
      add_noise(plan, kAxes[axis], noise, noise_.sign(block, axis), values[axis]->data());
    }
  }
}

void MppiOptimizer::add_smoothness(const Rollouts& rollouts, float* costs) const {
  const auto per_vx = static_cast<float>(gamma_ / (model_.noise_std.vx * model_.noise_std.vx));
  const auto per_wz = static_cast<float>(gamma_ / (model_.noise_std.wz * model_.noise_std.wz));
  run_lanes([&]() TRIDENT_LANES {
    for (int step = 1; step < rollouts.steps; ++step) {
      const float* vx = rollouts.at(rollouts.vx, step);
      const float* wz = rollouts.at(rollouts.wz, step);
      for (int i = 0; i < kLanes; ++i) {
        const float dv = vx[i] - vx[i - kLanes];
        const float dw = wz[i] - wz[i - kLanes];
        costs[i] += per_vx * dv * dv + per_wz * dw * dw;
      }
    }
  });
}

void MppiOptimizer::rate(const CriticScene& scene, const Rollouts& rollouts, float* costs) const {
  std::fill(costs, costs + kLanes, 0.0F);
  add_smoothness(rollouts, costs);
  for (const auto& critic : critics_) {
    if (critic->is_active(scene)) critic->add(scene, rollouts, costs);
  }
}

void MppiOptimizer::keep(int block, const Rollouts& rollouts) {
  const std::vector<float>* const values[] = {&rollouts.vx, &rollouts.vy, &rollouts.wz};
  const auto size = static_cast<std::ptrdiff_t>(rollouts.vx.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::copy(values[axis]->begin(), values[axis]->end(), kept_[axis].begin() + block * size);
  }
}

std::vector<float> MppiOptimizer::weights() const {
  const float best = *std::min_element(costs_.begin(), costs_.end());
  const auto inverse = static_cast<float>(-1.0 / temperature_);
  std::vector<float> weights(costs_.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < costs_.size(); ++i) {
    weights[i] = std::exp(inverse * (costs_[i] - best));
    sum += static_cast<double>(weights[i]);
  }
  for (float& weight : weights) weight = static_cast<float>(static_cast<double>(weight) / sum);
  return weights;
}

ControlPlan MppiOptimizer::mean(const std::vector<float>& weights) const {
  ControlPlan plan(static_cast<std::size_t>(model_.steps));
  constexpr double Twist2::*kAxes[] = {&Twist2::vx, &Twist2::vy, &Twist2::wz};
  const std::size_t size = static_cast<std::size_t>(model_.steps) * kLanes;
  std::vector<float> sums(size);
  for (int axis = 0; axis < 3; ++axis) {
    std::fill(sums.begin(), sums.end(), 0.0F);
    for (int block = 0; block < model_.blocks; ++block) {
      add_weighted(kept_[axis].data() + static_cast<std::size_t>(block) * size,
                   weights.data() + block * kLanes, model_.steps, sums.data());
    }
    for (int step = 0; step < model_.steps; ++step) {
      plan[static_cast<std::size_t>(step)].*kAxes[axis] = lane_sum(sums.data() + step * kLanes);
    }
  }
  return plan;
}

ControlPlan MppiOptimizer::kept_sample(std::size_t index) const {
  ControlPlan plan;
  const std::size_t block = index / kLanes;
  for (int step = 0; step < model_.steps; ++step) {
    const std::size_t i =
        (block * static_cast<std::size_t>(model_.steps) + static_cast<std::size_t>(step)) * kLanes +
        index % kLanes;
    plan.push_back({static_cast<double>(kept_[0][i]), static_cast<double>(kept_[1][i]),
                    static_cast<double>(kept_[2][i])});
  }
  return plan;
}

void MppiOptimizer::describe(const Pose2& start, const TrajectoryVisualizerParams& shown,
                             std::vector<ConsideredTrajectory>* noted) const {
  const auto every = static_cast<std::size_t>(shown.trajectory_step);
  for (std::size_t i = 0; i < costs_.size(); i += every) {
    noted->push_back(trajectory_of(kept_sample(i), start, model_.dt_s,
                                   static_cast<std::size_t>(shown.time_step)));
    noted->back().cost = static_cast<double>(costs_[i]);
  }
}

RatedPlan MppiOptimizer::optimize(const ControlPlan& plan, const Rollouts& deliberate,
                                  const CriticScene& scene, const RolloutStart& start,
                                  const ObstacleSurvey& survey) {
  pool_.share(static_cast<std::size_t>(model_.blocks), [&](std::size_t part, std::size_t worker) {
    const int block = static_cast<int>(part);
    Rollouts& rollouts = workers_[worker];
    if (block == 0) {
      rollouts = deliberate;
    } else {
      sample(block, plan, &rollouts);
      roll_out(model_, start, &rollouts);
      survey.survey(&rollouts);
    }
    rate(scene, rollouts, costs_.data() + block * kLanes);
    keep(block, rollouts);
  });
  Rollouts& rollouts = workers_.front();
  const auto best =
      static_cast<std::size_t>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
  const ControlPlan candidates[] = {mean(weights()), kept_sample(best)};
  for (int lane = 0; lane < kLanes; ++lane) write_lane(candidates[lane % 2], lane, &rollouts);
  roll_out(model_, start, &rollouts);
  survey.survey(&rollouts);
  float rated[kLanes];
  rate(scene, rollouts, rated);
  const int chosen = rated[0] <= rated[1] ? 0 : 1;
  return {read_lane(rollouts, chosen), static_cast<double>(rated[chosen]),
          rollouts.contact_step[static_cast<std::size_t>(chosen)]};
}

}  // namespace trident::nav
