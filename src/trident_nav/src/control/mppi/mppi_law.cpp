// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "../laws.h"
#include "../maneuver_follower.h"
#include "../steering.h"
#include "critics/critic_scene.h"
#include "deliberate_samples.h"
#include "mppi_optimizer.h"
#include "trident_base/yaml_config.h"

namespace trident::nav {
namespace {

/// Model predictive path integral control with Nav2's critics. What no parameter says is derived
/// from the robot: distances from its footprint, speeds from its limits, noise from its
/// accelerations, the horizon from the time that braking and passing its own size take.
class MppiLaw final : public ControlLaw {
 public:
  MppiLaw(const ControlSetup& setup, const MppiParams& params)
      : params_(params),
        model_(make_mppi_model(params, setup)),
        optimizer_(model_, params, setup.seed, setup.threads),
        deliberate_(model_.steps),
        trail_(2.0 * model_.length_m) {
    if (params_.follow_maneuvers && ManeuverFollower::is_needed(setup)) maneuvers_.emplace(setup);
    reset();
  }

  double path_length_m() const override {
    return params_.prune_distance.value_or(1.2 * model_.length_m);
  }
  Proposal propose(const Situation& situation) override;
  void on_sent(const Twist2& twist) override { sent_ = twist; }
  void reset() override {
    plan_.assign(static_cast<std::size_t>(model_.steps), Twist2{});
    trail_.clear();
    if (maneuvers_) maneuvers_->reset();
    optimizer_.rewind_noise();
    sent_ = {};
    last_time_s_ = 0.0;
    has_time_ = false;
  }

 private:
  void shift_plan(double time_s);
  RatedPlan optimized(const Situation& situation, const CostGrid& grid, const RolloutStart& start);
  Twist2 command_of(const Situation& situation, const RolloutStart& start) const;
  bool is_contact_imminent(const RatedPlan& rated, const Twist2& twist) const;
  void describe(const Situation& situation, double cost) const;

  MppiParams params_;
  MppiModel model_;
  MppiOptimizer optimizer_;
  Rollouts deliberate_;
  Trail trail_;
  std::optional<ManeuverFollower> maneuvers_;
  GridWithDistances distances_;
  ControlPlan plan_;
  Twist2 sent_;
  double last_time_s_ = 0.0;
  bool has_time_ = false;
};

void MppiLaw::shift_plan(double time_s) {
  const double elapsed_s = has_time_ ? time_s - last_time_s_ : 0.0;
  if (elapsed_s > 0.0 && elapsed_s < model_.horizon_s()) {
    plan_ = shifted(plan_, model_.dt_s, elapsed_s);
  } else if (elapsed_s != 0.0) {
    plan_.assign(plan_.size(), Twist2{});
  }
  last_time_s_ = time_s;
  has_time_ = true;
}

RatedPlan MppiLaw::optimized(const Situation& situation, const CostGrid& grid,
                             const RolloutStart& start) {
  CriticScene scene = make_critic_scene(model_, situation, grid);
  const SurveyOptions options{params_.ObstaclesCritic.consider_footprint,
                              params_.CostCritic.trajectory_point_step};
  const ObstacleSurvey survey(model_, situation.checker, grid, scene.origin, options);
  RatedPlan rated;
  for (int round = 0; round < params_.iteration_count + params_.retry_attempt_limit; ++round) {
    write_deliberate_samples(model_, scene, start, plan_, trail_, &deliberate_);
    roll_out(model_, start, &deliberate_);
    survey.survey(&deliberate_);
    find_furthest(deliberate_, &scene);
    rated = optimizer_.optimize(plan_, deliberate_, scene, start, survey);
    plan_ = rated.plan;
    const bool is_free = rated.contact_step >= model_.steps;
    if (round + 1 >= params_.iteration_count && is_free) break;
    if (!is_free) plan_.assign(plan_.size(), Twist2{});
  }
  optimizer_.advance_noise();
  plan_ = rated.plan;
  return rated;
}

Twist2 MppiLaw::command_of(const Situation& situation, const RolloutStart& start) const {
  Twist2 twist = plan_at(plan_, start.twist, model_.dt_s, model_.period_s);
  if (!situation.path.reaches_goal) return twist;
  // Whatever the plan hopes for, the robot must be able to stop at the goal.
  return slowed_to(
      stopping_speed(distance_left(situation), model_.limits.decel_max, model_.period_s), twist);
}

/// Whether the robot could no longer stop before the plan's first contact.
bool MppiLaw::is_contact_imminent(const RatedPlan& rated, const Twist2& twist) const {
  const double contact_s = model_.dt_s * (rated.contact_step + 1);
  return rated.contact_step < model_.steps &&
         contact_s <= model_.period_s + braking_time(model_.limits, twist);
}

void MppiLaw::describe(const Situation& situation, double cost) const {
  ControlDetails& details = *situation.details;
  const Pose2& pose = situation.state.pose;
  if (params_.visualize) {
    optimizer_.describe(pose, params_.TrajectoryVisualizer, &details.trajectories);
  }
  details.selected = details.trajectories.size();
  details.trajectories.push_back(trajectory_of(plan_, pose, model_.dt_s, 1));
  details.trajectories.back().cost = cost;
}

Proposal MppiLaw::propose(const Situation& situation) {
  const CostGrid grid = distances_.of(situation.grid);
  trail_.add(situation.state.pose, grid.geometry.resolution);
  shift_plan(situation.state.time_s);
  if (maneuvers_) {
    if (const auto twist = maneuvers_->follow(situation)) return {*twist, Failure::kNone, ""};
  }
  const RolloutStart start{situation.state.pose.yaw,
                           params_.open_loop ? sent_ : situation.state.twist};
  const RatedPlan rated = optimized(situation, grid, start);
  if (situation.watched.trajectories) describe(situation, rated.cost);
  if (is_contact_imminent(rated, start.twist)) {
    return {
        {}, Failure::kBlocked, "Every sampled trajectory is in contact within the braking time."};
  }
  return {command_of(situation, start), Failure::kNone, ""};
}

}  // namespace

void add_mppi(ControlLawRegistry& registry) {
  ControlLawFactory factory = [](const ControlSetup& setup, const ConfigNode& params,
                                 const std::string& label) {
    return std::make_unique<MppiLaw>(setup, load_config_node<MppiParams>(params, label));
  };
  factory.fields = config_fields<MppiParams>();
  registry.add("mppi", factory);
  registry.add("nav2_mppi_controller::MPPIController", factory);
}

}  // namespace trident::nav
