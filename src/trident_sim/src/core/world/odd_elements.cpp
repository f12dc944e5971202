// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// What does not stop a world: elements that cannot be used, and a floor that is not there.
#include <algorithm>
#include <cstdint>
#include <limits>

#include "trident_base/error.h"
#include "trident_sim/sea.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

constexpr double kLongFall_m = 100.0;
const SimTime kFloorPeriod = SimTime::from_seconds(1.0);

/// Whether the model has gone down by that much since it was spawned, and continues to.
bool falls(const Model& model) {
  const Link* const link = model.canonical_link();
  if (model.is_static || link == nullptr || link->body == nullptr) return false;
  const double fall_m = model.T_world_model_initial.p.z() - model.T_world_model().p.z();
  return fall_m > kLongFall_m && link->body->velocity().z() < 0.0;
}

}  // namespace

/// Once in the world, and not where anything could stop a fall: ground, a wall, or the sea.
void World::report_missing_floor() {
  next_floor_look_ = time_ + kFloorPeriod;
  const bool has_floor = ports_.find(kSeaPort, PortDirection::kOut) != nullptr ||
                         std::any_of(models_.begin(), models_.end(), [](const auto& entry) {
                           return entry.second->has_static_shapes();
                         });
  if (has_floor) return;
  const auto fallen = std::find_if(models_.begin(), models_.end(),
                                   [](const auto& entry) { return falls(*entry.second); });
  if (fallen == models_.end()) return;
  next_floor_look_ = SimTime{std::numeric_limits<std::int64_t>::max()};
  diagnose({Severity::kWarning,
            "world '" + name_ + "'",
            "no floor",
            "model '" + fallen->first +
                "' has fallen 100 m, and nothing in the world could stop it: there is no static "
                "shape such as model://ground_plane",
            {{"model", fallen->first}}});
}

}  // namespace trident::sim
