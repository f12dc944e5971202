// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_sim/param_tree.h"
#include "trident_sim/port.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

class World;
class Model;
struct Link;
struct SensorSpec;

/// One step leads from the state at `begin` to the state at `end` = begin + dt.
struct StepInfo {
  std::uint64_t step = 0;  ///< number of the step since time zero, the first is 1
  SimTime begin, end, dt;  ///< end = begin + dt
  double dt_s = 0.0;       ///< dt as PhysicsSpec has it, without rounding to nanoseconds
  /// Number of the step since the models were reset. Noise and sample rates count by it, so that
  /// they start again with every reset.
  std::uint64_t sample = 0;
};

/// When in a step a plugin runs. Within a phase plugins run in model name order, then in file
/// order.
enum class Phase {
  kSense,    ///< pre_step: measure the state at `begin` (RotorS' plugins measure here)
  kControl,  ///< pre_step: turn measurements and set-points into commands
  kActuate,  ///< pre_step: turn commands into forces
  kPost      ///< post_step: measure the state at `end`
};

/// What a plugin is given when it is made. World, model, link and sensor outlive the plugin.
struct PluginContext {
  World& world;  ///< for its ports, files, seed and timing; the model is not in it yet
  Model* model;  ///< nullptr for a world plugin
  /// The content of the `<plugin>` element. Valid while the plugin is constructed, not afterwards.
  const PluginParams& params;
  std::string name;      ///< "model::plugin", the name of its random stream
  Link* link = nullptr;  ///< of a sensor's plugin: what the sensor sits on; else nullptr
  const SensorSpec* sensor = nullptr;  ///< of a sensor's plugin; else nullptr
};

/// A vehicle part, sensor or world effect. Constructed when its model is spawned (a bad parameter
/// throws Error and refuses the model), then called once per step in each phase of phases(), always
/// by the stepping thread, then destroyed when the model is deleted. It gives its ports back itself
/// through PortHandle.
class Plugin {
 public:
  virtual ~Plugin() = default;
  /// When it wants to be called. Asked for whenever models come or go; must not change.
  virtual std::vector<Phase> phases() const = 0;
  /// Called in each of the phases kSense, kControl and kActuate that phases() names. The world's
  /// time is still info.begin.
  virtual void pre_step(Phase /*phase*/, World& /*world*/, const StepInfo& /*info*/) {}
  /// Called in phase kPost, when the world's time is info.end. It may measure but not act.
  virtual void post_step(const World& /*world*/, const StepInfo& /*info*/) {}
  /// Back to the state after construction (filters, biases, sample counters).
  virtual void reset() {}
  /// Of a world's plugin: models came or went, between steps. It may add ports and give them back.
  virtual void models_changed() {}
  /// The frame of a body of the model has moved in it: the mass of a link was set.
  virtual void body_frames_moved() {}
  /// Saves or restores every member that changes from step to step; a snapshot of the world is only
  /// as complete as this.
  virtual void state(StateArchive& /*archive*/) {}
};

/// Owns a port of the board for as long as a plugin lives.
template <class P>
class PortHandle {
 public:
  /// Owns nothing.
  PortHandle() = default;
  /// Takes over the duty to release `port`; `board` must outlive the handle.
  PortHandle(PortBoard& board, P* port) : board_(&board), port_(port) {}
  /// `other` owns nothing afterwards.
  PortHandle(PortHandle&& other) noexcept { *this = std::move(other); }
  /// Exchanges what both own; `other` releases it when it dies.
  PortHandle& operator=(PortHandle&& other) noexcept {
    std::swap(board_, other.board_);
    std::swap(port_, other.port_);
    return *this;
  }
  ~PortHandle() {
    if (port_ != nullptr) board_->release(port_);
  }
  /// Precondition: it owns a port.
  P* operator->() const { return port_; }
  P* get() const { return port_; }                             ///< nullptr when it owns nothing
  explicit operator bool() const { return port_ != nullptr; }  ///< whether it owns a port

 private:
  PortBoard* board_ = nullptr;
  P* port_ = nullptr;
};

/// Made by advertise() in a plugin's constructor.
template <class T>
using OutHandle = PortHandle<OutPort<T>>;
/// Made by subscribe() in a plugin's constructor.
template <class T>
using InHandle = PortHandle<InPort<T>>;

}  // namespace trident::sim
