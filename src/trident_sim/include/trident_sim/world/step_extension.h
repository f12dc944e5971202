// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <typeindex>
#include <utility>
#include <vector>

#include "trident_sim/plugin.h"

namespace trident::sim {

/// A part of the simulator that follows a world's steps without the core knowing it, such as the
/// scenes that rays are cast in. The world owns it (see StepExtensions) and calls it by the
/// stepping thread.
class StepExtension {
 public:
  virtual ~StepExtension() = default;
  /// As World::step() begins. What the plugins of an earlier step deferred, and an error that ended
  /// that step left undone, must be dropped.
  virtual void begin_steps() = 0;
  /// After the last plugin of a phase in which sensors measure: kSense and kPost.
  virtual void end_phase(Phase phase) = 0;
};

/// The extensions of a world, at most one of each type, in the order in which they were first asked
/// for.
class StepExtensions {
 public:
  /// The extension of type E. It is made by E(world) when it is first asked for, and lives as long
  /// as the world's plugins.
  template <class E>
  E& get(World& world) {
    const std::type_index type(typeid(E));
    for (const auto& [known, extension] : extensions_) {
      if (known == type) return static_cast<E&>(*extension);
    }
    extensions_.emplace_back(type, std::make_unique<E>(world));
    return static_cast<E&>(*extensions_.back().second);
  }
  /// Calls StepExtension::begin_steps() of each.
  void begin_steps() {
    for (const auto& [type, extension] : extensions_) extension->begin_steps();
  }
  /// Calls StepExtension::end_phase() of each.
  void end_phase(Phase phase) {
    for (const auto& [type, extension] : extensions_) extension->end_phase(phase);
  }

 private:
  std::vector<std::pair<std::type_index, std::unique_ptr<StepExtension>>> extensions_;
};

}  // namespace trident::sim
