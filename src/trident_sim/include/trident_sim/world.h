// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_base/worker_pool.h"
#include "trident_sim/axis_params.h"
#include "trident_sim/contact.h"
#include "trident_sim/diagnostics.h"
#include "trident_sim/joint_drive.h"
#include "trident_sim/model.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/port.h"
#include "trident_sim/samples.h"
#include "trident_sim/sdf_loader.h"
#include "trident_sim/snapshot.h"
#include "trident_sim/step_extension.h"

namespace trident::sim {

class PhysicsEngine;

/// How measurements and commands are delayed.
enum class LoopTiming {
  /// As RotorS on Gazebo: state k is measured as step k+1 begins and stamped (k+1) dt; the command
  /// computed from it moves the motors as step k+3 begins.
  kRotors,
  /// No artificial delay: state k is measured as step k ends and stamped k dt; the command computed
  /// from it acts in step k+1.
  kDirect
};

/// Where the world reports problems that do not stop it. One call per event.
using ReportSink = std::function<void(Severity, const std::string&)>;

/// What a world is made with besides its file. Everything that a run depends on is here or in the
/// file, so that equal options and commands give equal runs.
struct WorldOptions {
  std::uint64_t seed = 0;  ///< of all noise; each plugin draws from a stream of its own name
  /// Acts on plugins as they are made, and cannot change afterwards
  LoopTiming timing = LoopTiming::kRotors;
  ReportSink report;  ///< called by the thread that steps or spawns; empty: dropped
  /// What names of frames begin with in a robot's namespace (ROS' parameter tf_prefix); none: "".
  std::function<std::string(const std::string& robot_namespace)> tf_prefix{};
  /// Threads that share the work of lidars and cameras, 1 to 256. Results do not depend on it.
  std::size_t sensor_threads = 1;
  /// Where the first of what diagnostics() keeps is reported; none: to `report`.
  ReportSink diagnosed{};
  /// What is done with models, collisions and plugins that cannot be made.
  OddElements odd_elements = OddElements::kRefuse;
};

/// A model to be put into the world as text, as /gazebo/spawn_sdf_model has it.
struct SpawnRequest {
  std::string name;             ///< "": the name in the file
  std::string xml;              ///< SDF or URDF text
  std::string label;            ///< names the source in errors; "": the model's name
  std::string robot_namespace;  ///< given to plugins that have no <robotNamespace>
  SE3 T_world_model;            ///< replaces the pose in the file; q need not be normalized
};

/// The simulated world: models, physics, plugins, ports and time. Not thread-safe: one thread at a
/// time. Nothing in it reads a clock, prints or draws unseeded random numbers.
class World {
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

  /// Of the current state: step_count() steps after the last reset(), unless the step size changed.
  SimTime time() const { return time_; }
  /// Number of steps since the world began or reset() was called; reset_models() does not change
  /// it.
  std::uint64_t step_count() const { return step_count_; }
  SimTime dt() const { return dt_; }  ///< of the next step
  /// WorldOptions::seed. A plugin makes its RandomStream of it and of PluginContext::name.
  std::uint64_t seed() const { return options_.seed; }
  /// WorldOptions::timing, fixed for the world's life
  LoopTiming timing() const { return options_.timing; }
  /// What the frame names of robots in this namespace begin with; "" without
  /// WorldOptions::tf_prefix.
  std::string tf_prefix(const std::string& robot_namespace) const {
    return options_.tf_prefix ? options_.tf_prefix(robot_namespace) : "";
  }
  const std::string& name() const { return name_; }  ///< as in the world file
  /// Where plugins find the files that their parameters name.
  const Resources& resources() const { return resources_; }
  /// As last set; its step size is that of the next step
  const PhysicsSpec& physics() const { return physics_; }
  /// Throws Error when a value is out of range.
  /// Replaces solver settings, gravity and step size from the next step on.
  void set_physics(const PhysicsSpec& physics);
  /// Where on the Earth the world's origin lies, for GNSS receivers and magnetometers.
  const SphericalCoordinates& spherical() const { return spherical_; }
  const SceneSpec& scene() const { return scene_; }  ///< for cameras: ambient light and background
  /// Of the world file, in its order
  const std::vector<LightSpec>& lights() const { return lights_; }

  /// All models by name. Plugins run in this order, and state_hash() takes models in it.
  const std::map<std::string, std::unique_ptr<Model>>& models() const { return models_; }
  /// nullptr when no model has this name. Valid until the model is removed.
  Model* find_model(const std::string& name) const;
  /// Changes whenever a model comes or goes.
  std::uint64_t models_version() const { return models_version_; }
  /// "model::link", or a link name that is unique in the world; nullptr when unknown.
  Link* find_link(const std::string& scoped_name) const;

  /// Puts the model frame somewhere; velocities turn along with the bodies. Throws Error for a
  /// static model, a number that is not finite, beyond 1e7 m, or a zero quaternion. The jump is no
  /// acceleration: an IMU does not measure it.
  void set_model_pose(Model& model, const SE3& T_world_model);
  /// Moves the whole model as one rigid body with the velocity v [m/s] of its model frame and the
  /// angular velocity w [rad/s]. Throws Error beyond 1e5 m/s or 1e4 rad/s, or what is not finite.
  void set_model_twist(Model& model, const Eigen::Vector3d& v_world,
                       const Eigen::Vector3d& w_world);
  /// Places the body that the link is part of, so that the link has this pose, and its origin this
  /// velocity [m/s], [rad/s]. Joints that no longer fit are pulled together by the engine. Throws
  /// Error as set_model_pose() and set_model_twist() do.
  void set_link_state(Link& link, const SE3& T_world_link, const Eigen::Vector3d& v_world,
                      const Eigen::Vector3d& w_world);

  /// Mass, centre of mass, inertia and weight of a link, from the next step on; what it is part of
  /// continues to move as it does. Snapshots from before fit no more. Throws Error when mass or a
  /// principal inertia is not > 0.
  void set_link_inertial(Link& link, const Inertial& inertial, bool gravity);
  /// Throws Error, and changes nothing, for a value out of range, or a joint without such an axis.
  void set_axis_params(Joint& joint, std::size_t axis, const AxisParams& params);
  /// Turns or shifts joints of `model` to positions, with all that hangs on their children; of a
  /// universal joint the first axis. Returns the joints that were stopped by a limit. Throws
  /// Error, and moves nothing, for a joint that is unknown, has no position or closes a loop.
  std::vector<std::string> set_joint_positions(
      Model& model, const std::vector<std::pair<std::string, double>>& positions);

  /// A wrench on a body from `start` for `duration` (negative: until cleared). Frames: world axes,
  /// applied at `p_link` of the link.
  struct AppliedWrench {
    Link* link;                                         ///< not nullptr, and not static
    Eigen::Vector3d force_world, torque_world, p_link;  ///< [N], [N m], and [m] in the link's frame
    SimTime start, duration;  ///< acts in every step that ends after `start`; start 0: at once
  };
  /// Wrenches add up. Throws Error for a static link, or a component that is not finite, beyond
  /// 1e15, or a point beyond 1e7 m.
  void apply_wrench(const AppliedWrench& wrench);
  /// Ends all wrenches on the link, those that have not started included.
  void clear_wrenches(const Link& link);
  /// A torque or force along an axis of a joint, over the same span of time as a wrench.
  struct AppliedEffort {
    Joint* joint;             ///< not nullptr
    double effort;            ///< [N m] or [N]
    SimTime start, duration;  ///< duration negative: until cleared
    std::size_t axis = 0;     ///< of a universal joint or gearbox, 0 or 1
  };
  /// Throws Error for an axis that the joint does not have, or an effort that is not finite or
  /// beyond 1e15.
  void apply_effort(const AppliedEffort& effort);
  /// Ends all efforts on all axes of the joint, but not its drives.
  void clear_efforts(const Joint& joint);

  /// Drives an axis of a joint from now on, in place of a drive that it has. The drive lives until
  /// it is removed or replaced, or the joint's model goes. Throws Error as JointDrive does.
  JointDrive& add_drive(Joint& joint, const DriveSpec& spec, std::size_t axis = 0);
  /// nullptr when the axis has no drive. Owned by the world.
  JointDrive* find_drive(const Joint& joint, std::size_t axis = 0) const;
  /// Without such a drive nothing happens.
  void remove_drive(const Joint& joint, std::size_t axis = 0);

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
  /// Hands a text to WorldOptions::report as it is. For what a user should see each time it occurs;
  /// what may occur in every step goes to diagnose().
  void report(Severity severity, const std::string& text) const;
  /// Counts it among diagnostics(), and reports the first of its name.
  void diagnose(Diagnostic diagnostic);
  /// The same without a report: for what is reported by its cause. Returns whether it is the first.
  bool note(Diagnostic diagnostic);
  /// What occurred since the world began, those of deleted models left out. Not part of its state.
  const Diagnostics& diagnostics() const { return diagnostics_; }

  /// What was left out or changed in the files of this world and its models, a sentence each.
  const std::vector<std::string>& odd_elements() const { return odd_elements_; }

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
  void apply_external(const StepInfo& info);
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
  void report_odd(const std::string& text);
  void leave_out_if_odd(const std::function<void()>& load);
  void report_missing_floor();
  void drop_references(const Model& model);
  void restore_drives(const std::vector<JointDrive>& drives);
  std::vector<std::string> inventory() const;
  void state(StateArchive& archive);

  std::string name_;
  PhysicsSpec physics_;
  SphericalCoordinates spherical_;
  SceneSpec scene_;
  std::vector<LightSpec> lights_;
  Resources resources_;
  PluginRegistry& registry_;
  WorldOptions options_;
  WorkerPool workers_;
  Diagnostics diagnostics_;
  std::set<std::string> reported_elements_;  ///< of plugins, that none of them reads
  std::vector<std::string> odd_elements_;
  SimTime next_floor_look_;  ///< see report_missing_floor()
  PortBoard ports_;
  std::unique_ptr<PhysicsEngine> engine_;
  std::map<std::string, std::unique_ptr<Model>> models_;
  std::vector<std::unique_ptr<Plugin>> world_plugins_;
  std::vector<Plugin*> schedule_[4];
  std::vector<AppliedWrench> wrenches_;
  std::vector<AppliedEffort> efforts_;
  std::vector<std::unique_ptr<JointDrive>> drives_;
  SimTime time_, dt_;
  std::uint64_t step_count_ = 0;
  std::uint64_t reset_step_ = 0;  ///< step count of the last reset of the models
  std::uint64_t spawn_count_ = 0;
  std::uint64_t models_version_ = 0;
  std::shared_ptr<const int> identity_ = std::make_shared<int>();
  bool profiling_ = false;
  StageTimes stage_times_;
  StepExtensions extensions_;
};

}  // namespace trident::sim
