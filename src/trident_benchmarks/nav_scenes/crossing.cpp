// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "crossing.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "stepped_drive.h"
#include "trident_base/angle.h"

namespace trident::benchmarks {
namespace {

constexpr double kWalkPeriod_s = 0.02;
// A touch ends when robot and walker were apart for so long.
constexpr double kApart_s = 0.3;
constexpr char kWalkerName[] = "walker_";

std::string walker_sdf(const WalkerParams& params) {
  const std::string shape = "<geometry><cylinder><radius>" + std::to_string(params.radius) +
                            "</radius><length>" + std::to_string(params.height) +
                            "</length></cylinder></geometry>";
  return "<sdf version=\"1.6\"><model name=\"walker\"><link name=\"body\"><kinematic>1</kinematic>"
         "<gravity>0</gravity><inertial><mass>70</mass></inertial><collision name=\"body\">" +
         shape + "</collision></link></model></sdf>";
}

nav::Pose2 placed(const nav::Pose2& frame, const nav::Pose2& pose) {
  const nav::Point2 p = nav::transform(frame, {pose.x, pose.y});
  return {p.x, p.y, nav::wrap_angle(frame.yaw + pose.yaw)};
}

nav::Pose2 pose_of(const std::array<double, 3>& values) {
  return {values[0], values[1], values[2]};
}

/// Of a shape's scoped name: the number of the walker that it is, or -1.
int walker_of(const std::string& scoped_name) {
  const std::size_t length = sizeof kWalkerName - 1;
  if (scoped_name.compare(0, length, kWalkerName) != 0) return -1;
  return std::atoi(scoped_name.c_str() + length);
}

class Crossing {
 public:
  Crossing(const CrossingConfig& config, const ConfigNode& parameters, std::uint64_t seed)
      : config_(config),
        start_(pose_of(config.trial.start)),
        drive_(config.trial, parameters, seed),
        walkers_(config.walkers, seed, {start_.x, start_.y}) {
    drive_.set_localized(true);
    spawn_walkers();
  }

  CrossingResult run() {
    const TrialConfig& trial = config_.trial;
    while (!is_over_ && drive_.time_s() < trial.settle_s + trial.time_limit_s) {
      if (drive_.time_s() >= walked_s_ + kWalkPeriod_s) walk();
      if (!has_goal_) begin_when_settled();
      const auto output = drive_.step();
      note_contacts();
      if (output) note(*output);
      if (config_.frame_period_s > 0.0) note_frame();
    }
    result_.time_s = drive_.time_s() - trial.settle_s;
    result_.navigation_cpu_s = drive_.navigation_cpu_s();
    return std::move(result_);
  }

 private:
  void begin_when_settled() {
    if (drive_.time_s() < config_.trial.settle_s) return;
    drive_.set_goal(pose_of(config_.trial.goal));
    has_goal_ = true;
  }

  void spawn_walkers() {
    sim::World& world = drive_.robot().world();
    sim::SpawnRequest request;
    request.xml = walker_sdf(config_.walkers);
    for (std::size_t i = 0; i < walkers_.all().size(); ++i) {
      const nav::Point2& p = walkers_.all()[i].position;
      request.name = kWalkerName + std::to_string(i);
      // A little above the floor, which they do not touch.
      constexpr double kAbove_m = 0.02;
      request.T_world_model.p = {p.x, p.y, 0.5 * config_.walkers.height + kAbove_m};
      sim::Model& model = world.spawn(request);
      for (sim::Geom* geom : model.collision_shapes(*model.links.front())) geom->add_watcher();
      models_.push_back(&model);
    }
  }

  void walk() {
    walked_s_ = drive_.time_s();
    for (std::size_t i = 0; i < models_.size(); ++i) {
      const Eigen::Vector3d& p = models_[i]->T_world_model().p;
      walkers_.set_position(i, {p.x(), p.y()});
    }
    walkers_.step(kWalkPeriod_s);
    for (std::size_t i = 0; i < models_.size(); ++i) {
      const nav::Point2& v = walkers_.all()[i].velocity;
      drive_.robot().world().set_model_twist(*models_[i], {v.x, v.y, 0.0}, Eigen::Vector3d::Zero());
    }
  }

  bool involves_robot(const sim::Contact& contact) const {
    const std::string own = config_.trial.robot_name + "::";
    return contact.geom1->scoped_name().compare(0, own.size(), own) == 0 ||
           contact.geom2->scoped_name().compare(0, own.size(), own) == 0;
  }

  void note_contacts() {
    for (const sim::Contact& contact : drive_.robot().world().contacts()) {
      if (!involves_robot(contact)) continue;
      const std::string &first = contact.geom1->scoped_name(),
                        &second = contact.geom2->scoped_name();
      const int walker = std::max(walker_of(first), walker_of(second));
      if (walker >= 0) {
        touch(static_cast<std::size_t>(walker), contact.p_world);
      } else if (result_.wall.empty() && !is_pushed()) {
        result_.wall = first + ", " + second;
      }
    }
  }

  /// A robot that was just pushed by somebody did not drive into what it touches by itself.
  bool is_pushed() const {
    constexpr double kAfter_s = 0.5;
    return std::any_of(result_.touches.begin(), result_.touches.end(), [&](const Touch& touch) {
      return drive_.time_s() - touch.last_s < kAfter_s;
    });
  }

  void touch(std::size_t walker, const Eigen::Vector3d& p_world) {
    for (Touch& old : result_.touches) {
      if (old.walker != walker || drive_.time_s() - old.last_s > kApart_s) continue;
      old.last_s = drive_.time_s();
      return;
    }
    const sim::Body& base = *drive_.robot().model().links.front()->body;
    const Eigen::Vector3d v =
        base.previous_velocity() + base.previous_angular_velocity().cross(p_world - base.pose().p);
    Eigen::Vector3d toward = models_[walker]->T_world_model().p - p_world;
    toward.z() = 0.0;
    result_.touches.push_back(
        {drive_.time_s(), walker, v.dot(toward.normalized()), drive_.time_s(), is_pushed()});
  }

  void note(const nav::NavigatorOutput& output) {
    result_.recoveries += output.recovery ? 1 : 0;
    if (!has_goal_ || output.status == nav::NavigatorStatus::kActive) return;
    result_.text = output.text;
    result_.has_arrived = output.status == nav::NavigatorStatus::kSucceeded;
    is_over_ = true;
  }

  void note_frame() {
    if (drive_.time_s() < framed_s_ + config_.frame_period_s) return;
    framed_s_ = drive_.time_s();
    CrossingFrame frame{
        framed_s_, drive_.robot().truth(), drive_.command(), {}, drive_.stack().tracks()};
    for (const Walker& walker : walkers_.all()) frame.walkers.push_back(walker.position);
    for (nav::Track& track : frame.tracks) {
      const nav::Pose2 p = placed(start_, {track.position.x, track.position.y, 0.0});
      const nav::Pose2 v =
          placed({0.0, 0.0, start_.yaw}, {track.velocity.x, track.velocity.y, 0.0});
      track.position = {p.x, p.y};
      track.velocity = {v.x, v.y};
    }
    result_.frames.push_back(std::move(frame));
  }

  const CrossingConfig& config_;
  nav::Pose2 start_;
  SteppedDrive drive_;
  Walkers walkers_;
  std::vector<sim::Model*> models_;
  CrossingResult result_;
  double walked_s_ = -1.0, framed_s_ = -1.0;
  bool has_goal_ = false, is_over_ = false;
};

}  // namespace

CrossingResult run_crossing(const CrossingConfig& config, const ConfigNode& parameters,
                            std::uint64_t seed) {
  return Crossing(config, parameters, seed).run();
}

}  // namespace trident::benchmarks
