// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// The whole state of one world between two steps, kept in memory: bodies, rotors, joints, drives,
/// applied forces, plugins with their noise, ports, time and physics settings. What models are made
/// of (masses, surfaces, gains) and who listens to ports is not state. Cheap to copy, and good for
/// any number of restores, as long as the models of the world are the same ones.
class Snapshot {
 public:
  SimTime time() const { return content_->time; }  ///< of the state that was saved
  /// Of the state that was saved.
  std::uint64_t step_count() const { return content_->step_count; }

 private:
  friend class World;
  struct Content {
    std::shared_ptr<const int> world;    ///< identity of the world
    std::vector<std::string> inventory;  ///< of models and ports
    StateArchive::Store values;
    SimTime time;
    std::uint64_t step_count = 0;
  };
  explicit Snapshot(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

  std::shared_ptr<const Content> content_;
};

}  // namespace trident::sim
