// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What ConstraintSolver keeps of a step for the friction of the next one.
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "constraint_solver.h"

namespace trident::sim {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::size_t number_of(const EngineBody* body) {
  return body == nullptr ? ContactMemory::kWorld : body->number;
}

bool is_of(const ContactMemory& memory, const Touch& touch) {
  return memory.a == number_of(touch.a) && memory.b == number_of(touch.b);
}

bool is_same_pair(const Touch& one, const Touch& other) {
  return number_of(one.a) == number_of(other.a) && number_of(one.b) == number_of(other.b);
}

std::unordered_map<const EngineBody*, std::size_t> places_in(
    const std::vector<EngineBody*>& bodies) {
  std::unordered_map<const EngineBody*, std::size_t> places;
  for (std::size_t i = 0; i < bodies.size(); ++i) places[bodies[i]] = i;
  return places;
}

}  // namespace

/// Contacts come in nearly the same order in every step: each is looked for behind the last one.
void ConstraintSolver::recall(Touch& touch) {
  touch.known_normal_n = {kUnknown, kUnknown};
  const bool is_first = touches_.size() < 2 || !is_same_pair(touches_[touches_.size() - 2], touch);
  touch.index = is_first ? 0 : touches_[touches_.size() - 2].index + 1;
  for (std::size_t i = 0; i < memory_.size(); ++i) {
    const std::size_t at = (next_in_memory_ + i) % memory_.size();
    if (!is_of(memory_[at], touch) || memory_[at].index != touch.index) continue;
    touch.known_normal_n = memory_[at].normal_n;
    next_in_memory_ = at + 1;
    return;
  }
}

void ConstraintSolver::remember() {
  memory_.clear();
  for (const Touch& touch : touches_) {
    memory_.push_back({number_of(touch.a), number_of(touch.b), touch.index, touch.known_normal_n});
  }
}

/// Small islands of which every contact was there in the last step.
void ConstraintSolver::choose_warm(Pass pass) {
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    is_warm_[held_.islands[i]] = active_[held_.islands[i]] && !is_large(held_.islands[i]);
  }
  for (Touch& touch : touches_) {
    const std::size_t island = island_of(touch);
    if (!active_[island]) continue;
    touch.normal_n = kUnknown;
    touch.limiting_normal_n = touch.known_normal_n[static_cast<std::size_t>(pass)];
    // One new contact changes the forces of all others of its island.
    if (std::isnan(touch.limiting_normal_n)) is_warm_[island] = 0;
  }
}

/// An island that is solved once has the normal forces of both passes.
void ConstraintSolver::keep_normals(Pass pass) {
  for (Touch& touch : touches_) {
    const bool is_once = !is_solved_twice_[island_of(touch)];
    if (is_once) touch.known_normal_n.fill(touch.normal_n);
    touch.known_normal_n[static_cast<std::size_t>(pass)] = touch.normal_n;
  }
}

void ConstraintSolver::state(StateArchive& archive) { archive(memory_); }

void ConstraintSolver::renumber(const std::vector<EngineBody*>& before,
                                const std::vector<EngineBody*>& now) {
  const std::unordered_map<const EngineBody*, std::size_t> numbers = places_in(now);
  // Bodies are numbered again when models come or go; the memory of those that stay is kept.
  const auto follow = [&](std::size_t& number) {
    if (number == ContactMemory::kWorld) return true;
    const auto found = numbers.find(before[number]);
    if (found != numbers.end()) number = found->second;
    return found != numbers.end();
  };
  std::vector<ContactMemory> kept;
  for (ContactMemory memory : memory_) {
    if (follow(memory.a) && follow(memory.b)) kept.push_back(memory);
  }
  memory_ = std::move(kept);
}

}  // namespace trident::sim
