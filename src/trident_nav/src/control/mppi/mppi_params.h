// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "vessel_motion.h"

namespace trident::nav {

enum class MppiMotion { kDiffDrive, kOmni, kAckermann, kVessel };
constexpr auto enum_names(MppiMotion) {
  return std::array{
      EnumName{MppiMotion::kDiffDrive, "DiffDrive"}, EnumName{MppiMotion::kOmni, "Omni"},
      EnumName{MppiMotion::kAckermann, "Ackermann"}, EnumName{MppiMotion::kVessel, "Vessel"}};
}

/// What all critics have.
struct CriticParams {
  bool enabled = true;
  int cost_power = 1;
  double cost_weight = 1.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("enabled", enabled, "it scores");
    ar.field("cost_power", cost_power, Range{1, 4}, "exponent of the cost");
    ar.field("cost_weight", cost_weight, Range::non_negative(), "factor of the cost");
  }
};

/// A critic that scores only nearer to the goal than a distance, or only farther.
struct ThresholdCriticParams : CriticParams {
  std::optional<double> threshold_to_consider;

  ThresholdCriticParams() = default;
  explicit ThresholdCriticParams(double weight) { cost_weight = weight; }

  template <class Archive>
  void visit(Archive& ar) {
    CriticParams::visit(ar);
    ar.field("threshold_to_consider", threshold_to_consider, Range::non_negative(),
             "from the goal; default: by the horizon's length or the footprint [m]");
  }
};

struct PathAlignParams : ThresholdCriticParams {
  PathAlignParams() : ThresholdCriticParams(10.0) {}
  double max_path_occupancy_ratio = 0.07;
  int offset_from_furthest = 20;
  int trajectory_point_step = 4;
  bool use_path_orientations = false;

  template <class Archive>
  void visit(Archive& ar) {
    ThresholdCriticParams::visit(ar);
    ar.field("max_path_occupancy_ratio", max_path_occupancy_ratio, Range{0.0, 1.0},
             "where more of the path is blocked the critic is silent");
    ar.field("offset_from_furthest", offset_from_furthest, Range::non_negative(),
             "points of the path that must be within reach");
    ar.field("trajectory_point_step", trajectory_point_step, Range::at_least(1),
             "each so many-th point counts");
    ar.field("use_path_orientations", use_path_orientations, "headings count, too");
  }
};

struct PathAngleParams : ThresholdCriticParams {
  PathAngleParams() : ThresholdCriticParams(2.2) {}
  int offset_from_furthest = 4;
  double max_angle_to_furthest = 0.785;
  int mode = 0;

  template <class Archive>
  void visit(Archive& ar) {
    ThresholdCriticParams::visit(ar);
    ar.field("offset_from_furthest", offset_from_furthest, Range::non_negative(),
             "points of the path beyond the furthest one reached");
    ar.field("max_angle_to_furthest", max_angle_to_furthest, Range{0.0, 3.15},
             "smaller ones do not count [rad]");
    ar.field("mode", mode, Range{0, 2},
             "0 prefers forward, 1 has no preference, 2 takes the path's own headings");
  }
};

struct PathFollowParams : ThresholdCriticParams {
  PathFollowParams() : ThresholdCriticParams(5.0) {}
  int offset_from_furthest = 6;

  template <class Archive>
  void visit(Archive& ar) {
    ThresholdCriticParams::visit(ar);
    ar.field("offset_from_furthest", offset_from_furthest, Range::non_negative(),
             "points of the path beyond the furthest one reached");
  }
};

struct CostCriticParams : CriticParams {
  CostCriticParams() { cost_weight = 3.81; }
  int near_collision_cost = 253;
  double critical_cost = 300.0;
  double collision_cost = 1e6;
  bool consider_footprint = true;
  std::optional<double> near_goal_distance;
  std::string inflation_layer_name;
  int trajectory_point_step = 2;

  template <class Archive>
  void visit(Archive& ar) {
    CriticParams::visit(ar);
    ar.field("near_collision_cost", near_collision_cost, Range{1, 253},
             "cells' costs from which the critical cost applies");
    ar.field("critical_cost", critical_cost, Range::non_negative(), "of such a point");
    ar.field("collision_cost", collision_cost, Range::positive(), "of a trajectory in contact");
    ar.field("consider_footprint", consider_footprint, "the polygon, not the inscribed circle");
    ar.field("near_goal_distance", near_goal_distance, Range::non_negative(),
             "nearer, only contacts count; default: the circumscribed radius [m]");
    ar.field("inflation_layer_name", inflation_layer_name, "not needed here");
    ar.field("trajectory_point_step", trajectory_point_step, Range::at_least(1),
             "each so many-th point counts");
  }
};

struct ObstaclesParams : CriticParams {
  double repulsion_weight = 1.5;
  double critical_weight = 20.0;
  double collision_cost = 1e5;
  std::optional<double> collision_margin_distance;
  double speed_margin = 0.05;
  std::optional<double> near_goal_distance;
  bool consider_footprint = true;
  std::optional<double> inflation_radius;
  double cost_scaling_factor = 10.0;
  std::string inflation_layer_name;

  template <class Archive>
  void visit(Archive& ar) {
    CriticParams::visit(ar);
    ar.field("repulsion_weight", repulsion_weight, Range::non_negative(),
             "of nearness, at distances up to the inflation's");
    ar.field("critical_weight", critical_weight, Range::non_negative(),
             "of nearness within the margin");
    ar.field("collision_cost", collision_cost, Range::positive(), "of a trajectory in contact");
    ar.field("collision_margin_distance", collision_margin_distance, Range::positive(),
             "default: half the inscribed radius [m]");
    ar.field("speed_margin", speed_margin, Range::non_negative(),
             "how much the margin grows with the speed [s]");
    ar.field("near_goal_distance", near_goal_distance, Range::non_negative(),
             "nearer, no repulsion; default: the circumscribed radius [m]");
    ar.field("consider_footprint", consider_footprint, "the polygon, not the inscribed circle");
    ar.field("inflation_radius", inflation_radius, Range::positive(),
             "how far repulsion reaches; default: twice the inscribed radius [m]");
    ar.field("cost_scaling_factor", cost_scaling_factor, Range::positive(), "not needed here");
    ar.field("inflation_layer_name", inflation_layer_name, "not needed here");
  }
};

struct DeadbandParams : CriticParams {
  DeadbandParams() { cost_weight = 35.0; }
  std::array<double, 3> deadband_velocities{};

  template <class Archive>
  void visit(Archive& ar) {
    CriticParams::visit(ar);
    ar.field("deadband_velocities", deadband_velocities, Range::non_negative(),
             "vx, vy [m/s], wz [rad/s] below which the base does not move");
  }
};

struct TrackCriticParams : CriticParams {
  TrackCriticParams() { cost_weight = 5.0; }
  double collision_cost = 1e5;
  std::optional<double> margin;
  double sigmas = 1.0;

  template <class Archive>
  void visit(Archive& ar) {
    CriticParams::visit(ar);
    ar.field("collision_cost", collision_cost, Range::positive(), "of a trajectory in contact");
    ar.field("margin", margin, Range::positive(),
             "how far repulsion reaches; default: twice the inscribed radius [m]");
    ar.field("sigmas", sigmas, Range::non_negative(),
             "standard deviations of the prediction that are kept free");
  }
};

struct AckermannParams {
  std::optional<double> min_turning_r;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("min_turning_r", min_turning_r, Range::positive(),
             "default: of the robot's limits [m]");
  }
};

/// What of the sampled trajectories is shown.
struct TrajectoryVisualizerParams {
  int trajectory_step = 5;
  int time_step = 3;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("trajectory_step", trajectory_step, Range{1, 100000}, "every so many trajectories");
    ar.field("time_step", time_step, Range{1, 1000}, "every so many steps of a trajectory");
  }
};

/// Names and defaults of Nav2's nav2_mppi_controller. What has no value is derived from the robot.
struct MppiParams {
  int batch_size = 2000;
  int time_steps = 56;
  std::optional<double> model_dt;
  int iteration_count = 1;
  double temperature = 0.3;
  double gamma = 0.015;
  std::optional<double> vx_max, vx_min, vy_max, wz_max;
  std::optional<double> ax_max, ax_min, ay_max, ay_min, az_max;
  std::optional<double> vx_std, vy_std, wz_std;
  std::optional<MppiMotion> motion_model;
  AckermannParams AckermannConstraints;
  VesselConstraintsParams VesselConstraints;
  int retry_attempt_limit = 1;
  bool regenerate_noises = false;
  bool open_loop = false;
  bool visualize = false;
  bool follow_maneuvers = true;
  TrajectoryVisualizerParams TrajectoryVisualizer;
  std::optional<double> prune_distance;
  double transform_tolerance = 0.1;
  std::vector<std::string> critics{"ConstraintCritic", "ObstaclesCritic",     "GoalCritic",
                                   "GoalAngleCritic",  "PathAlignCritic",     "PathFollowCritic",
                                   "PathAngleCritic",  "PreferForwardCritic", "TrackCritic"};
  CriticParams ConstraintCritic{true, 1, 4.0};
  CostCriticParams CostCritic;
  ObstaclesParams ObstaclesCritic;
  ThresholdCriticParams GoalCritic{5.0};
  ThresholdCriticParams GoalAngleCritic{3.0};
  PathAlignParams PathAlignCritic;
  PathAngleParams PathAngleCritic;
  PathFollowParams PathFollowCritic;
  ThresholdCriticParams PreferForwardCritic{5.0};
  CriticParams TwirlingCritic{true, 1, 10.0};
  DeadbandParams VelocityDeadbandCritic;
  TrackCriticParams TrackCritic;

  template <class Archive>
  void visit(Archive& ar) {
    visit_sampling(ar);
    visit_limits(ar);
    visit_critics(ar);
  }

 private:
  template <class Archive>
  void visit_sampling(Archive& ar) {
    ar.field("batch_size", batch_size, Range{1, 100000}, "trajectories per iteration");
    ar.field("time_steps", time_steps, Range{2, 1000}, "of a trajectory");
    ar.field("model_dt", model_dt, Range::positive(),
             "of a step; default: the horizon is what braking, passing the footprint eight times "
             "or turning around takes [s]");
    ar.field("iteration_count", iteration_count, Range{1, 10}, "per command");
    ar.field("temperature", temperature, Range::positive(), "of the weights of trajectories");
    ar.field("gamma", gamma, Range::non_negative(), "weight of the change of controls");
    ar.field("vx_std", vx_std, Range::positive(), "default: by limits and horizon [m/s]");
    ar.field("vy_std", vy_std, Range::positive(), "default: by limits and horizon [m/s]");
    ar.field("wz_std", wz_std, Range::positive(), "default: by limits and horizon [rad/s]");
    ar.field("retry_attempt_limit", retry_attempt_limit, Range::non_negative(),
             "iterations from rest where all trajectories are in contact");
    ar.field("regenerate_noises", regenerate_noises, "fresh noise for each command");
    ar.field("open_loop", open_loop, "the last command stands for the measured speed");
    ar.field("visualize", visualize, "the sampled trajectories are published");
    ar.field("follow_maneuvers", follow_maneuvers,
             "a base that turns in circles follows the arcs about its changes of gear exactly");
    ar.field("TrajectoryVisualizer", TrajectoryVisualizer, "which of them");
    ar.field("prune_distance", prune_distance, Range::positive(),
             "of the path that is looked at; default: the horizon's length [m]");
    ar.field("transform_tolerance", transform_tolerance, Range::non_negative(), "[s]");
  }
  template <class Archive>
  void visit_limits(Archive& ar) {
    ar.field("motion_model", motion_model, "default: by the robot's limits");
    ar.field("AckermannConstraints", AckermannConstraints, "of the motion model Ackermann");
    ar.field("VesselConstraints", VesselConstraints, "of the motion model Vessel");
    ar.field("vx_max", vx_max, Range::positive(), "default: the robot's limit [m/s]");
    ar.field("vx_min", vx_min, Range::at_most(0.0), "default: the robot's limit [m/s]");
    ar.field("vy_max", vy_max, Range::non_negative(), "default: the robot's limit [m/s]");
    ar.field("wz_max", wz_max, Range::positive(), "default: the robot's limit [rad/s]");
    ar.field("ax_max", ax_max, Range::positive(), "default: the robot's limit [m/s^2]");
    ar.field("ax_min", ax_min, Range::at_most(0.0), "default: the robot's limit [m/s^2]");
    ar.field("ay_max", ay_max, Range::positive(), "default: the robot's limit [m/s^2]");
    ar.field("ay_min", ay_min, Range::at_most(0.0), "default: the robot's limit [m/s^2]");
    ar.field("az_max", az_max, Range::positive(), "default: the robot's limit [rad/s^2]");
  }
  template <class Archive>
  void visit_critics(Archive& ar) {
    ar.field("critics", critics, "names of those that score, in order");
    ar.field("ConstraintCritic", ConstraintCritic, "speeds beyond the limits");
    ar.field("CostCritic", CostCritic, "the costmap's costs");
    ar.field("ObstaclesCritic", ObstaclesCritic, "distances from obstacles");
    ar.field("GoalCritic", GoalCritic, "distance from the goal");
    ar.field("GoalAngleCritic", GoalAngleCritic, "heading at the goal");
    ar.field("PathAlignCritic", PathAlignCritic, "deviation from the path");
    ar.field("PathAngleCritic", PathAngleCritic, "heading along the path");
    ar.field("PathFollowCritic", PathFollowCritic, "progress along the path");
    ar.field("PreferForwardCritic", PreferForwardCritic, "driving backwards");
    ar.field("TwirlingCritic", TwirlingCritic, "turning");
    ar.field("VelocityDeadbandCritic", VelocityDeadbandCritic, "speeds that do not move the base");
    ar.field("TrackCritic", TrackCritic, "moving obstacles where they will be");
  }
};

}  // namespace trident::nav
