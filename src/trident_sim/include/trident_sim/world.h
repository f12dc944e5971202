// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_base/worker_pool.h"
#include "trident_sim/model.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/port.h"
#include "trident_sim/samples.h"
#include "trident_sim/world/applied_loads.h"
#include "trident_sim/world/contact.h"
#include "trident_sim/world/model_set.h"
#include "trident_sim/world/snapshot.h"
#include "trident_sim/world/step_extension.h"
#include "trident_sim/world/world_clock.h"
#include "trident_sim/world/world_reports.h"
#include "trident_sim/world/world_setting.h"

namespace trident::sim {

/// A model to be put into the world as text, as /gazebo/spawn_sdf_model has it.
struct SpawnRequest {
  std::string name;             ///< "": the name in the file
  std::string xml;              ///< SDF or URDF text
  std::string label;            ///< names the source in errors; "": the model's name
  std::string robot_namespace;  ///< given to plugins that have no <robotNamespace>
  SE3 T_world_model;            ///< replaces the pose in the file; q need not be normalized
};

/// The simulated world: models, physics, plugins, ports and time. Not thread-safe: one thread at a
/// time. Nothing in it prints or draws unseeded random numbers, and no clock is read but for
/// set_profiling(). Its bases have one job each, and a function that needs no more takes that base:
/// what the world is (WorldSetting), when (WorldClock), what it reports (WorldReports), its models
/// (ModelSet) and what acts on them from outside (AppliedLoads). The world itself makes models with
/// their plugins, and steps.
class World : public WorldSetting,
              public WorldClock,
              public WorldReports,
              public ModelSet,
              public AppliedLoads {
 public:
  /// Builds the models and plugins of `spec` and keeps a reference to `registry`, which must
  /// outlive the world. Throws Error for physics, models or plugins that cannot be made; with
  /// OddElements::kLeaveOut what cannot be made is listed in odd_elements() instead.
  World(const WorldSpec& spec, const Resources& resources, PluginRegistry& registry,
        WorldOptions options);
  /// Plugins go before the bodies that they hold references to.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Throws Error (bad model, name taken) and leaves the world as it was.
  Model& spawn(const SpawnRequest& request);
  /// The same for a model that was read before, at spec.T_world_model and under spec.name. The
  /// reference is valid until the model is removed.
  Model& spawn(ModelSpec spec, const std::string& robot_namespace);
  /// Throws Error when there is no such model.
  /// Deletes a model with its plugins and ports, and all wrenches, efforts and drives that act on
  /// it.
  void remove(const std::string& name);

  /// Advances by `n` steps of physics().max_step_size_s.
  void step(std::uint64_t n = 1);

  /// Poses, velocities, joints, drives and plugins, with their filters and noise, as spawned, and
  /// no forces applied from outside; time and the number of the step continue.
  void reset_models();
  /// reset_models() and time zero.
  void reset();

  /// The state as it is now. To be called between steps.
  Snapshot save_snapshot();
  /// Goes back to a state of this world: the steps that follow are those that followed it then, to
  /// the bit, if the same commands come. Throws Error when models or ports have come or gone since
  /// then, and leaves the world as it was.
  void restore_snapshot(const Snapshot& snapshot);

  /// As last set; its step size is that of the next step
  const PhysicsSpec& physics() const { return physics_; }
  /// Throws Error when a value is out of range.
  /// Replaces solver settings, gravity and step size from the next step on.
  void set_physics(const PhysicsSpec& physics);
  /// Contacts of the last step of collisions that are watched (Geom::watchers), two by two in an
  /// order that is the same in every run.
  const std::vector<Contact>& contacts() const;

  /// What follows the steps from outside the core, rays for one (see ray_scene.h).
  StepExtensions& extensions() { return extensions_; }

  /// For work within a step that is worth sharing, and whose result does not depend on who does it.
  WorkerPool& workers() { return workers_; }

  /// Where plugins leave samples and find commands; how a middleware reads and writes them, too.
  PortBoard& ports() { return ports_; }
  const PortBoard& ports() const { return ports_; }  ///< to look only
  /// SHA-256 over name, pose, velocities and rotor speeds of every model in name order, as
  /// IEEE-754 bytes, with the step count.
  std::string state_hash() const;

  /// Wall nanoseconds per stage since the last call, when profiling is on.
  struct StageTimes {
    std::uint64_t steps = 0;  ///< over which the times were summed up
    double sense_s = 0, control_s = 0, actuate_s = 0, physics_s = 0, post_s = 0;  ///< wall time [s]
  };
  /// Off at first, as it reads the clock around every stage of every step.
  void set_profiling(bool on) { profiling_ = on; }
  /// Returns the sums and sets them back to zero.
  StageTimes take_stage_times();

 private:
  void rebuild_schedule();
  void run_phase(Phase phase, const StepInfo& info);
  StepInfo next_step() const;
  void sense(const StepInfo& info);
  void actuate(const StepInfo& info);
  void finish_step(const StepInfo& info);
  Model& add_model(ModelSpec spec, const std::string& robot_namespace);
  std::unique_ptr<Model> build_model(ModelSpec spec, const std::string& robot_namespace);
  void create_plugins(Model& model, const std::vector<PluginSpec>& specs);
  void create_sensor(Model& model, const LinkSpec& link, SensorSpec& sensor);
  /// Where a plugin belongs: to the world, a model, or a sensor on a link.
  struct PluginPlace {
    Model* model = nullptr;
    Link* link = nullptr;
    const SensorSpec* sensor = nullptr;
  };
  std::unique_ptr<Plugin> create_plugin(const PluginSpec& spec, const PluginPlace& place,
                                        const std::string& owner);
  void report_unread(const PluginSpec& spec, const PluginParams& params);
  void report_overlap(const Model& model);
  void report_missing_floor();
  std::vector<std::string> inventory() const;
  void state(StateArchive& archive);

  PhysicsSpec physics_;
  PluginRegistry& registry_;
  WorkerPool workers_;
  std::set<std::string> reported_elements_;  ///< of plugins, that none of them reads
  SimTime next_floor_look_;                  ///< see report_missing_floor()
  PortBoard ports_;
  std::vector<std::unique_ptr<Plugin>> world_plugins_;
  std::vector<Plugin*> schedule_[4];
  std::shared_ptr<const int> identity_ = std::make_shared<int>();
  bool profiling_ = false;
  StageTimes stage_times_;
  StepExtensions extensions_;
};

}  // namespace trident::sim
