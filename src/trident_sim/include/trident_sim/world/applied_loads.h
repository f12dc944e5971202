// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_sim/model.h"
#include "trident_sim/plugin.h"
#include "trident_sim/world/joint_drive.h"

namespace trident::sim {

/// What acts on links and joints from outside of the models: wrenches, efforts and drives.
class AppliedLoads {
 public:
  AppliedLoads(const AppliedLoads&) = delete;
  AppliedLoads& operator=(const AppliedLoads&) = delete;

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

 protected:
  AppliedLoads() = default;
  ~AppliedLoads() = default;

  /// Adds what acts in a step to the bodies and joints, drives last.
  void apply_loads(const StepInfo& info);
  /// Ends wrenches and efforts; drives are as they were made.
  void reset_loads();
  /// What is held by address must not outlive the links and joints of a model.
  void drop_loads_on(const Model& model);
  void restore_drives(const std::vector<JointDrive>& drives);

  std::vector<AppliedWrench> wrenches_;
  std::vector<AppliedEffort> efforts_;
  std::vector<std::unique_ptr<JointDrive>> drives_;

 private:
  void apply_wrenches_and_efforts(const StepInfo& info);
};

}  // namespace trident::sim
