// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "agent.h"
#include "session.h"
#include "trident_base/worker_pool.h"

namespace trident::sim {

/// How many there are of what a rollout reads and writes.
struct RolloutSizes {
  std::size_t worlds = 0, agents = 0;       ///< agents in each world
  std::size_t action = 0, observation = 0;  ///< numbers of each agent
};

/// The loop of a learner: worlds side by side, in each the same agents; actions in, observations
/// and terms of rewards out. Nothing in here needs the interpreter's lock.
class Rollout {
 public:
  /// `steps` of the world follow each action. Throws Error when something is not there, or agents
  /// differ in the size of their actions or observations.
  Rollout(std::vector<std::shared_ptr<Session>> sessions, const std::vector<AgentSpec>& agents,
          std::uint64_t steps, std::size_t threads);

  const RolloutSizes& sizes() const { return sizes_; }
  /// An episode begins in a world, with a goal for each agent.
  void begin(std::size_t world, Span<const Goal> goals);
  void set_goals(std::size_t world, Span<const Goal> goals);
  /// As the world is now.
  void observe(std::size_t world, float* observations);

  /// Where step() writes, row by row: worlds, agents, numbers.
  struct Results {
    float* observations;
    double* terms;
  };
  /// Acts and steps in all worlds but those that rest (nullptr: none), whose rows are left as they
  /// are. Throws Error for an action that is not finite, and steps no world then.
  void step(const float* actions, const bool* resting, const Results& results);
  std::string state_hash(std::size_t world) const;

 private:
  struct Stage {
    std::shared_ptr<Session> session;
    std::vector<std::unique_ptr<Agent>> agents;
    std::uint64_t models_version = 0, ports_version = 0;
  };
  Stage& stage(std::size_t world);
  void resolve(Stage& stage, World& world) const;
  void step_one(std::size_t number, const float* actions, const Results& results);
  void check_finite(const float* actions, const bool* resting) const;

  std::vector<AgentSpec> specs_;
  std::vector<Stage> stages_;
  std::uint64_t steps_;
  WorkerPool workers_;
  RolloutSizes sizes_;
};

}  // namespace trident::sim
