// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Saving and restoring a World.
#include "trident_sim/world/snapshot.h"

#include <algorithm>

#include "core/physics/physics_engine.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

/// The first entry that only one of two sorted lists has, expressed as a change of the second.
std::string difference(const std::vector<std::string>& then, const std::vector<std::string>& now) {
  for (const std::string& entry : then) {
    if (!std::binary_search(now.begin(), now.end(), entry)) return entry + " is gone";
  }
  for (const std::string& entry : now) {
    if (!std::binary_search(then.begin(), then.end(), entry)) return entry + " is new";
  }
  return "";
}

}  // namespace

/// What must be the same for a snapshot to fit: models by name and spawn number, ports by name.
std::vector<std::string> World::inventory() const {
  std::vector<std::string> entries;
  for (const auto& [name, model] : models_) {
    entries.push_back("model '" + name + "' (spawn " + std::to_string(model->spawn_number) + ")");
  }
  ports_.for_each([&entries](const PortBase& port) {
    entries.push_back((port.direction() == PortDirection::kOut ? "output '" : "input '") +
                      port.name() + "'");
  });
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// Everything but the drives, which may come and go. The order is that of names, and the same in
/// both directions.
void World::state(StateArchive& archive) {
  archive(time_, dt_, step_count_, reset_step_, physics_, wrenches_, efforts_);
  for (const auto& [name, model] : models_) {
    for (const auto& body : model->bodies) engine_body(*body).state(archive);
    for (const auto& joint : model->joints) joint->state(archive);
    for (const auto& plugin : model->plugins) plugin->state(archive);
  }
  for (const auto& plugin : world_plugins_) plugin->state(archive);
  ports_.for_each([&archive](PortBase& port) { port.state(archive); });
  engine_->state(archive);
}

Snapshot World::save_snapshot() {
  auto content = std::make_shared<Snapshot::Content>();
  content->world = identity_;
  content->inventory = inventory();
  content->time = time_;
  content->step_count = step_count_;
  StateArchive archive = StateArchive::saving(content->values);
  state(archive);
  std::vector<JointDrive> drives;
  for (const auto& drive : drives_) drives.push_back(*drive);
  archive(drives);
  return Snapshot(std::move(content));
}

void World::restore_snapshot(const Snapshot& snapshot) {
  const Snapshot::Content& content = *snapshot.content_;
  if (content.world != identity_) throw Error("the snapshot is of another world");
  if (const std::string news = difference(content.inventory, inventory()); !news.empty()) {
    throw Error("the snapshot of step " + std::to_string(content.step_count) +
                " does not fit the world any more: " + news);
  }
  StateArchive archive = StateArchive::restoring(content.values);
  state(archive);
  std::vector<JointDrive> drives;
  archive(drives);
  restore_drives(drives);
  engine_->configure(physics_);
  for (const auto& [name, model] : models_) engine_->push_state(*model);
}

}  // namespace trident::sim
