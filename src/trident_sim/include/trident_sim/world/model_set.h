// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trident_sim/model.h"
#include "trident_sim/world/axis_params.h"

namespace trident::sim {

class PhysicsEngine;

/// The models of a world, and what places or changes them by hand, between steps.
class ModelSet {
 public:
  ModelSet(const ModelSet&) = delete;
  ModelSet& operator=(const ModelSet&) = delete;

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

 protected:
  ModelSet();
  ~ModelSet();

  std::unique_ptr<PhysicsEngine> engine_;  ///< moves them; made by the world
  std::map<std::string, std::unique_ptr<Model>> models_;
  std::uint64_t spawn_count_ = 0;
  std::uint64_t models_version_ = 0;
};

}  // namespace trident::sim
