// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "rollout.h"

#include <cmath>
#include <string>

#include "trident_base/error.h"

namespace trident::sim {

Rollout::Rollout(std::vector<std::shared_ptr<Session>> sessions,
                 const std::vector<AgentSpec>& agents, std::uint64_t steps, std::size_t threads)
    : specs_(agents), steps_(steps), workers_(threads) {
  if (sessions.empty() || agents.empty()) throw Error("rollout: no world or no agent, legal: one");
  for (std::shared_ptr<Session>& session : sessions) {
    stages_.push_back({std::move(session), {}, 0, 0});
    resolve(stages_.back(), stages_.back().session->world());
  }
  const auto& team = stages_.front().agents;
  sizes_ = {stages_.size(), team.size(), team.front()->action_size(),
            team.front()->observation_size(team.size())};
  // All agents share one space of actions and one of observations.
  for (const auto& agent : team) {
    if (agent->action_size() != sizes_.action ||
        agent->observation_size(team.size()) != sizes_.observation) {
      throw Error("rollout: agents have actions or observations of different sizes, legal: equal");
    }
  }
}

/// Looks ports and models up again when any have come or gone.
void Rollout::resolve(Stage& stage, World& world) const {
  if (!stage.agents.empty() && stage.models_version == world.models_version() &&
      stage.ports_version == world.ports().version()) {
    return;
  }
  stage.agents.clear();
  for (const AgentSpec& spec : specs_) stage.agents.push_back(std::make_unique<Agent>(spec, world));
  stage.models_version = world.models_version();
  stage.ports_version = world.ports().version();
}

Rollout::Stage& Rollout::stage(std::size_t world) {
  if (world < stages_.size()) return stages_[world];
  throw Error("rollout: world is " + std::to_string(world) + ", legal: 0 to " +
              std::to_string(stages_.size() - 1));
}

void Rollout::begin(std::size_t world, Span<const Goal> goals) {
  Stage& chosen = stage(world);
  chosen.session->use([&](World& its_world) {
    resolve(chosen, its_world);
    for (std::size_t i = 0; i < sizes_.agents; ++i) chosen.agents[i]->begin(goals[i]);
  });
}

void Rollout::set_goals(std::size_t world, Span<const Goal> goals) {
  Stage& chosen = stage(world);
  for (std::size_t i = 0; i < sizes_.agents; ++i) chosen.agents[i]->set_goal(goals[i]);
}

void Rollout::observe(std::size_t world, float* observations) {
  Stage& chosen = stage(world);
  chosen.session->use([&](World& its_world) {
    resolve(chosen, its_world);
    for (const auto& agent : chosen.agents) agent->look();
    for (std::size_t i = 0; i < sizes_.agents; ++i) {
      chosen.agents[i]->observe(chosen.agents, observations + i * sizes_.observation);
    }
  });
}

void Rollout::check_finite(const float* actions, const bool* resting) const {
  const std::size_t count = sizes_.agents * sizes_.action;
  for (std::size_t world = 0; world < sizes_.worlds; ++world) {
    if (resting != nullptr && resting[world]) continue;
    for (std::size_t i = world * count; i < (world + 1) * count; ++i) {
      if (std::isfinite(actions[i])) continue;
      throw Error("action[" + std::to_string(i) + "] is " + std::to_string(actions[i]) +
                  ", legal: finite, -1 to 1 (what is beyond is cut)");
    }
  }
}

void Rollout::step_one(std::size_t number, const float* actions, const Results& results) {
  Stage& chosen = stages_[number];
  chosen.session->use([&](World& world) {
    resolve(chosen, world);
    const double period_s = world.physics().max_step_size_s * static_cast<double>(steps_);
    const std::size_t first = number * sizes_.agents;
    for (std::size_t i = 0; i < sizes_.agents; ++i) {
      const float* action = actions + (first + i) * sizes_.action;
      chosen.agents[i]->act({action, sizes_.action}, period_s);
    }
    // All act on the same state, then all look at the same
    // state: an agent's place in the list is no advantage.
    world.step(steps_);
    for (const auto& agent : chosen.agents) agent->look();
    for (std::size_t i = 0; i < sizes_.agents; ++i) {
      Agent& agent = *chosen.agents[i];
      agent.observe(chosen.agents, results.observations + (first + i) * sizes_.observation);
      const Terms terms = agent.judge(chosen.agents);
      std::copy(terms.values.begin(), terms.values.end(),
                results.terms + (first + i) * Terms::kCount);
    }
  });
}

void Rollout::step(const float* actions, const bool* resting, const Results& results) {
  check_finite(actions, resting);
  if (sizes_.worlds == 1) {
    if (resting == nullptr || !resting[0]) step_one(0, actions, results);
    return;
  }
  // Worlds share nothing, so that each steps as it would alone, on whichever thread.
  workers_.share(sizes_.worlds, [&](std::size_t world, std::size_t /*worker*/) {
    if (resting == nullptr || !resting[world]) step_one(world, actions, results);
  });
}

std::string Rollout::state_hash(std::size_t world) const {
  return stages_.at(world).session->world().state_hash();
}

}  // namespace trident::sim
