// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "dwb_critics.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trident_base/yaml_config.h"

namespace trident::nav {

constexpr auto enum_names(Aggregation) {
  return std::array{EnumName{Aggregation::kLast, "last"}, EnumName{Aggregation::kSum, "sum"},
                    EnumName{Aggregation::kProduct, "product"}};
}

namespace {

// What all critics have.
struct ScaleParams {
  std::string type;
  double scale = 1.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("class", type, "of the critic, where its name is another one");
    ar.field("scale", scale, Range::non_negative(), "of its score; 0: not asked");
  }
};

struct ObstacleParams : ScaleParams {
  bool sum_scores = false;

  ObstacleParams() { scale = 0.02; }
  template <class Archive>
  void visit(Archive& ar) {
    ScaleParams::visit(ar);
    ar.field("sum_scores", sum_scores, "scores of all poses, not the highest one");
  }
};

struct GridParams : ScaleParams {
  Aggregation aggregation_type = Aggregation::kLast;

  template <class Archive>
  void visit(Archive& ar) {
    ScaleParams::visit(ar);
    ar.field("aggregation_type", aggregation_type, "how scores of poses become one");
  }
};

/// Nav2's, or nearer for a small robot, in radii of its footprint: with a point farther ahead
/// TurtleBot3's burger turns to and fro at a corner that the point has passed, with a nearer one
/// Jackal does not leave a dead end (both in scenes_test.cpp).
constexpr double kForwardPoint = 0.325;  // [m]
constexpr double kForwardRadii = 1.25;

struct AlignParams : GridParams {
  double forward_point_distance = kForwardPoint;

  template <class Archive>
  void visit(Archive& ar) {
    GridParams::visit(ar);
    ar.field("forward_point_distance", forward_point_distance, Range::non_negative(),
             "of the scored point ahead of the base [m]");
  }
};

struct OscillationParams : ScaleParams {
  OscillationLimits limits;

  template <class Archive>
  void visit(Archive& ar) {
    ScaleParams::visit(ar);
    ar.field("oscillation_reset_dist", limits.reset_distance_m, Range::non_negative(), "[m]");
    ar.field("oscillation_reset_angle", limits.reset_angle, Range::non_negative(), "[rad]");
    ar.field("oscillation_reset_time", limits.reset_time_s, "negative: never [s]");
    ar.field("x_only_threshold", limits.x_only_threshold, Range::non_negative(),
             "of the forward speed, from which turns are free [m/s]");
  }
};

struct PreferForwardParams : ScaleParams {
  PreferForwardWeights weights;

  template <class Archive>
  void visit(Archive& ar) {
    ScaleParams::visit(ar);
    ar.field("penalty", weights.penalty, Range::non_negative(), "of driving backwards");
    ar.field("strafe_x", weights.strafe_x, Range::non_negative(),
             "a slower robot that turns slowly, too, gets the penalty [m/s]");
    ar.field("strafe_theta", weights.strafe_theta, Range::non_negative(), "[rad/s]");
    ar.field("theta_scale", weights.theta_scale, Range::non_negative(), "of turning");
  }
};

struct RotateToGoalParams : ScaleParams {
  std::optional<double> xy_goal_tolerance;
  std::optional<double> trans_stopped_velocity;
  double slowing_factor = 5.0;
  double lookahead_time = -1.0;

  RotateToGoalParams() { scale = 32.0; }
  template <class Archive>
  void visit(Archive& ar) {
    ScaleParams::visit(ar);
    ar.field("xy_goal_tolerance", xy_goal_tolerance, Range::positive(),
             "default: that of the goal [m]");
    ar.field("trans_stopped_velocity", trans_stopped_velocity, Range::non_negative(),
             "default: that of the goal [m/s]");
    ar.field("slowing_factor", slowing_factor, Range::non_negative(),
             "of the squared speed, within the tolerance");
    ar.field("lookahead_time", lookahead_time,
             "on the trajectory, at which the heading is compared; negative: at its end [s]");
  }
};

/// Within the tolerance of the goal's position first no more speed, then no translation; and the
/// goal's heading.
class RotateToGoalCritic final : public TrajectoryCritic {
 public:
  RotateToGoalCritic(const RotateToGoalParams& params, const DwbCriticSetup& setup)
      : TrajectoryCritic(params.scale),
        tolerance_m_(params.xy_goal_tolerance.value_or(setup.tolerance.xy_goal_tolerance)),
        stopped_(params.trans_stopped_velocity.value_or(setup.tolerance.trans_stopped_velocity)),
        slowing_factor_(params.slowing_factor) {
    const double steps = params.lookahead_time / setup.dt_s;
    if (params.lookahead_time >= 0.0) step_ = static_cast<int>(std::min(steps, 1e6));
  }

  void prepare(const DwaScene& scene) override {
    const Pose2& pose = scene.situation.state.pose;
    const Pose2& goal = scene.situation.goal;
    speed_ = std::hypot(scene.situation.state.twist.vx, scene.situation.state.twist.vy);
    is_near_ = distance(pose.x, pose.y, goal.x, goal.y) <= tolerance_m_;
    turns_ = is_near_ && (turns_ || speed_ <= stopped_);
  }

  double score(const DwaScene& scene, const Candidate& candidate) const override {
    if (!is_near_) return 0.0;
    const double speed = std::hypot(candidate.twist.vx, candidate.twist.vy);
    const bool is_forbidden = turns_ ? speed > 0.0 : speed >= speed_;
    if (is_forbidden) return -1.0;
    const int step = step_ ? std::min(*step_, candidate.last) : candidate.last;
    const double yaw = candidate.pose(scene.situation.state.pose, step).yaw;
    const double off = std::fabs(wrap_angle(scene.situation.goal.yaw - yaw));
    return turns_ ? off : off + slowing_factor_ * speed * speed;
  }

  void reset() override { turns_ = false; }

 private:
  double tolerance_m_, stopped_, slowing_factor_;
  std::optional<int> step_;
  double speed_ = 0.0;
  bool is_near_ = false;
  bool turns_ = false;
};

template <class Params>
Params read(const ConfigNode& node, const std::string& label, const std::string& name,
            Params params = {}) {
  config_detail::ConfigReader::read_struct(node, label, name, params);
  return params;
}

// Nav2's of the scales of grids, whose unit is a meter.
constexpr double kGridShare = 0.5;

// Scales of Nav2's bringup file, where a user gives no other.
DwbCriticFactory grid_critic(GridKind kind, double scale) {
  return [=](const DwbCriticSetup& /*setup*/, const ConfigNode& node, const std::string& label,
             const std::string& name) {
    GridParams params;
    params.scale = scale;
    params = read(node, label, name, params);
    return make_grid_critic(kind, kGridShare * params.scale, 0.0, 0.0, params.aggregation_type,
                            GridUnit::kMeters);
  };
}

DwbCriticFactory align_critic(GridKind kind, double scale) {
  return [=](const DwbCriticSetup& setup, const ConfigNode& node, const std::string& label,
             const std::string& name) {
    AlignParams params;
    params.scale = scale;
    params.forward_point_distance = std::min(kForwardPoint, kForwardRadii * setup.radius_m);
    params = read(node, label, name, params);
    const double ahead_m = params.forward_point_distance;
    // Next to the goal a point ahead of the base is beyond it.
    const double silent_m = std::min(ahead_m, setup.tolerance.xy_goal_tolerance);
    return make_grid_critic(kind, kGridShare * params.scale, ahead_m, silent_m,
                            params.aggregation_type, GridUnit::kMeters);
  };
}

DwbCriticFactory obstacle_critic(bool has_footprint) {
  return [=](const DwbCriticSetup& /*setup*/, const ConfigNode& node, const std::string& label,
             const std::string& name) {
    const auto params = read<ObstacleParams>(node, label, name);
    const Aggregation all = params.sum_scores ? Aggregation::kSum : Aggregation::kLast;
    return has_footprint ? make_footprint_critic(params.scale, all)
                         : make_obstacle_critic(params.scale, all);
  };
}

}  // namespace

Registry<DwbCriticFactory> dwb_critics() {
  Registry<DwbCriticFactory> registry("DWB critic");
  constexpr double kPathScale = 32.0;
  constexpr double kGoalScale = 24.0;
  registry.add("PathDist", grid_critic(GridKind::kPath, kPathScale));
  registry.add("GoalDist", grid_critic(GridKind::kGoal, kGoalScale));
  registry.add("PathAlign", align_critic(GridKind::kPath, kPathScale));
  registry.add("GoalAlign", align_critic(GridKind::kGoal, kGoalScale));
  registry.add("BaseObstacle", obstacle_critic(false));
  registry.add("ObstacleFootprint", obstacle_critic(true));
  registry.add("Twirling",
               [](const auto& /*setup*/, const auto& node, const auto& label, const auto& name) {
                 return make_twirling_critic(read<ScaleParams>(node, label, name).scale);
               });
  registry.add("PreferForward",
               [](const auto& /*setup*/, const auto& node, const auto& label, const auto& name) {
                 const auto params = read<PreferForwardParams>(node, label, name);
                 return make_prefer_forward_critic(params.scale, params.weights);
               });
  registry.add("Oscillation",
               [](const auto& /*setup*/, const auto& node, const auto& label, const auto& name) {
                 const auto params = read<OscillationParams>(node, label, name);
                 return make_oscillation_critic(params.scale, params.limits);
               });
  registry.add("RotateToGoal",
               [](const auto& setup, const auto& node, const auto& label,
                  const auto& name) -> std::unique_ptr<TrajectoryCritic> {
                 return std::make_unique<RotateToGoalCritic>(
                     read<RotateToGoalParams>(node, label, name), setup);
               });
  return registry;
}

std::string dwb_critic_type(const std::string& name) {
  const auto cut = name.find_last_of("/:");
  std::string type = cut == std::string::npos ? name : name.substr(cut + 1);
  const std::string suffix = "Critic";
  const bool has_suffix = type.size() > suffix.size() &&
                          type.compare(type.size() - suffix.size(), suffix.size(), suffix) == 0;
  if (has_suffix) type.resize(type.size() - suffix.size());
  return type;
}

}  // namespace trident::nav
