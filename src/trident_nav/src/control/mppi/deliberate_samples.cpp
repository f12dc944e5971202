// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "deliberate_samples.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::nav {
namespace {

// A path that leads off by more is first turned to on the spot [rad].
constexpr double kTurnFirst = 0.6;

// Pure pursuit of points by a robot that is simulated along.
class Pursuit {
 public:
  Pursuit(const MppiModel& model, const std::vector<Point2>& points, const RolloutStart& start,
          double speed, double lookahead_m)
      : model_(model),
        points_(points),
        pose_{0.0, 0.0, start.yaw},
        twist_(start.twist),
        speed_(speed),
        lookahead_m_(lookahead_m) {}

  Twist2 step() {
    const TwistWindow window = reachable_window(model_.limits, twist_, model_.dt_s);
    twist_ = admissible_twist(model_.limits, window, wanted());
    pose_ = integrate(pose_, twist_, model_.dt_s);
    return twist_;
  }

 private:
  double distance_to(std::size_t i) const {
    return distance(points_[i].x, points_[i].y, pose_.x, pose_.y);
  }
  void advance_target() {
    while (target_ + 1 < points_.size() && distance_to(target_) < lookahead_m_) ++target_;
  }
  Twist2 wanted() {
    advance_target();
    const double dx = points_[target_].x - pose_.x;
    const double dy = points_[target_].y - pose_.y;
    const double c = std::cos(pose_.yaw);
    const double s = std::sin(pose_.yaw);
    const double sign = speed_ < 0.0 ? -1.0 : 1.0;
    const double along = sign * (c * dx + s * dy);
    const double across = sign * (c * dy - s * dx);
    const double off = std::atan2(across, along);
    if (model_.can_turn() && std::fabs(off) > kTurnFirst) {
      const double wz = stopping_speed(std::fabs(off), model_.limits.alpha_max, model_.dt_s);
      return {0.0, 0.0, std::copysign(std::min(wz, model_.limits.wz_max), off)};
    }
    const double square = std::max(dx * dx + dy * dy, 1e-4);
    const double curvature = 2.0 * across / square;
    const double stop =
        target_ + 1 < points_.size()
            ? model_.limits.vx_max
            : stopping_speed(std::sqrt(square), model_.limits.decel_max, model_.dt_s);
    const double turn_limited = model_.limits.wz_max / std::max(std::fabs(curvature), 1e-6);
    const double hold_limited =
        std::sqrt(turning_acceleration(model_.limits) / std::max(std::fabs(curvature), 1e-6));
    const double v = std::min({std::fabs(speed_), stop, turn_limited, hold_limited});
    return {sign * v, 0.0, v * curvature};
  }

  const MppiModel& model_;
  const std::vector<Point2>& points_;
  Pose2 pose_;
  Twist2 twist_;
  double speed_, lookahead_m_;
  std::size_t target_ = 0;
};

ControlPlan constant(const MppiModel& model, const Twist2& twist) {
  return ControlPlan(static_cast<std::size_t>(model.steps), twist);
}

std::vector<Point2> path_points(const CriticScene& scene) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < scene.path_x.size(); ++i) {
    points.push_back({static_cast<double>(scene.path_x[i]), static_cast<double>(scene.path_y[i])});
  }
  return points;
}

// Arcs of a few speeds and turn rates, forward and, where the robot can, backwards.
ControlPlan arc_sample(const MppiModel& model, int index) {
  constexpr double kSpeeds[] = {1.0, 0.5, 0.2};
  constexpr double kTurns[] = {0.0, 0.25, -0.25, 0.6, -0.6, 1.0, -1.0};
  const int turn = index % 7;
  const int speed = (index / 7) % 3;
  const Twist2 twist{kSpeeds[speed] * model.limits.vx_max, 0.0, kTurns[turn] * model.limits.wz_max};
  return constant(model, twist);
}

// One plan after the other into lanes.
class LaneWriter {
 public:
  explicit LaneWriter(Rollouts* rollouts) : rollouts_(rollouts) {}
  void write(const ControlPlan& plan) {
    if (lane_ < kLanes) write_lane(plan, lane_++, rollouts_);
  }
  bool is_full() const { return lane_ >= kLanes; }

 private:
  Rollouts* rollouts_;
  int lane_ = 0;
};

void write_pursuits(const MppiModel& model, const CriticScene& scene, const RolloutStart& start,
                    LaneWriter* writer) {
  const std::vector<Point2> points = path_points(scene);
  const double near = 1.5 * model.circumscribed_radius;
  const bool is_backwards = scene.is_reverse && model.limits.vx_min < 0.0;
  const double full = is_backwards ? model.limits.vx_min : model.limits.vx_max;
  for (const double share : {1.0, 0.6, 0.3}) {
    for (const double lookahead_m : {near, 2.5 * near}) {
      writer->write(pursue(model, points, start, share * full, lookahead_m));
    }
  }
  // A path that begins behind a robot that has no room to turn.
  if (!is_backwards && model.limits.vx_min < 0.0) {
    writer->write(pursue(model, points, start, model.limits.vx_min, near));
  }
}

}  // namespace

void Trail::add(const Pose2& pose, double spacing_m) {
  const auto is_near = [&](const Pose2& last) {
    return distance(last.x, last.y, pose.x, pose.y) < spacing_m;
  };
  if (!poses_.empty() && is_near(poses_.back())) return;
  poses_.push_back(pose);
  const auto kept = static_cast<std::size_t>(length_m_ / spacing_m) + 2;
  if (poses_.size() > kept) poses_.erase(poses_.begin());
}

std::vector<Point2> Trail::backwards_from(const Pose2& pose) const {
  std::vector<Point2> points;
  for (auto p = poses_.rbegin(); p != poses_.rend(); ++p) {
    points.push_back({p->x - pose.x, p->y - pose.y});
  }
  return points;
}

ControlPlan pursue(const MppiModel& model, const std::vector<Point2>& points,
                   const RolloutStart& start, double speed, double lookahead_m) {
  ControlPlan plan;
  plan.reserve(static_cast<std::size_t>(model.steps));
  Pursuit pursuit(model, points, start, speed, lookahead_m);
  for (int step = 0; step < model.steps; ++step) plan.push_back(pursuit.step());
  return plan;
}

void write_deliberate_samples(const MppiModel& model, const CriticScene& scene,
                              const RolloutStart& start, const ControlPlan& last_plan,
                              const Trail& trail, Rollouts* rollouts) {
  LaneWriter writer(rollouts);
  writer.write(last_plan);
  writer.write(constant(model, {}));
  for (const double sign : {1.0, -1.0}) {
    writer.write(constant(model, {0.0, 0.0, sign * model.limits.wz_max}));
  }
  const std::vector<Point2> back = trail.backwards_from(scene.origin);
  if (!back.empty() && model.limits.vx_min < 0.0) {
    const double near = 1.5 * model.circumscribed_radius;
    writer.write(pursue(model, back, start, model.limits.vx_min, near));
    writer.write(constant(model, {model.limits.vx_min, 0.0, 0.0}));
  }
  write_pursuits(model, scene, start, &writer);
  for (int i = 0; !writer.is_full(); ++i) writer.write(arc_sample(model, i));
}

}  // namespace trident::nav
