// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "actuator.h"
#include "trident_base/se3.h"
#include "trident_base/span.h"
#include "trident_sim/samples.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// What a learner acts and sees through: one model of a world.
struct AgentSpec {
  std::string model;                ///< name of it
  ActuatorSpec actuator;            ///< what its actions drive
  std::vector<std::string> blocks;  ///< of its observation, in their order; see block_names()
  std::string scan;                 ///< output port of a planar lidar; "": none
  std::size_t beams = 0;            ///< that a scan is reduced to
};

/// Where an agent should be.
struct Goal {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< [m]
  double yaw_rad = 0.0;
};

/// What rewards are made of, in the order of the enumerators; see _rollout.py for their meaning.
struct Terms {
  enum Name {
    kDistance,
    kProgress,
    kSpeed,
    kTurnRate,
    kUp,
    kHeading,
    kEffort,
    kChange,
    kContact,
    kNearest,
    kCount
  };
  std::array<double, kCount> values{};
};

/// Names of all blocks that observations can be made of.
std::vector<std::string> block_names();

/// One agent in its world, ports and model resolved. A step looks no name up and, once it has run,
/// allocates nothing.
class Agent {
 public:
  /// Throws Error when the model, a port or a block is not there.
  Agent(const AgentSpec& spec, World& world);

  std::size_t action_size() const { return actuator_->size(); }
  const SE3& T_world_model() const { return now_.T_world_model; }

  /// An episode begins at the state as it is.
  void begin(const Goal& goal);
  /// Another goal in the same episode.
  void set_goal(const Goal& goal);
  /// Takes an action, numbers in [-1, 1] (what is beyond is cut), for the steps until the next one.
  void act(Span<const float> action, double period_s);
  /// Reads the state of the model. All agents of a world do, before any of them observes.
  void look();
  /// Of `count` agents of the world, this one among them.
  std::size_t observation_size(std::size_t count) const;
  /// Writes observation_size() numbers.
  void observe(Span<const std::unique_ptr<Agent>> team, float* out) const;
  /// What rewards are made of, since the last call.
  Terms judge(Span<const std::unique_ptr<Agent>> team);

 private:
  friend struct Blocks;
  struct State {
    SE3 T_world_model;
    Eigen::Matrix3d R_world_model;
    Eigen::Vector3d v_world, w_body;
    bool has_contact = false;
  };
  double yaw() const;
  void reduce_scan();
  double nearest(Span<const std::unique_ptr<Agent>> team) const;

  const Model* model_;
  std::unique_ptr<Actuator> actuator_;
  std::vector<std::size_t> blocks_;  // numbers in the table of blocks
  const OutPort<LaserScanSample>* scan_ = nullptr;
  std::vector<float> beams_;  // range over the largest one, 0 ... 1
  double nearest_beam_m_;
  State now_;
  Goal goal_;
  double distance_m_ = 0.0;           // at the last judge()
  std::vector<float> action_, last_;  // the newest, and the one before it
  std::vector<double> command_;
};

}  // namespace trident::sim
