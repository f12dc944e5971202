// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The controller nodes for a nodelet manager: with the simulator in the same one, odometry and
// motor commands pass as objects, and the simulator's stepping thread runs the control laws.
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "trident_base/error.h"
#include "trident_control_ros/controller_params.h"
#include "trident_control_ros/lee_position_controller_node.h"
#include "trident_control_ros/node_main.h"
#include "trident_control_ros/roll_pitch_yawrate_thrust_controller_node.h"

namespace trident::control {

/// With a bad parameter the manager does not get the nodelet.
class ControllerNodelet : public nodelet::Nodelet {
 public:
  void onInit() override {
    try {
      ros_utils::NodeParams params(getPrivateNodeHandle());
      node_ = make(getNodeHandle(), params);
      log_notes(params);
    } catch (const Error& error) {
      NODELET_FATAL("%s", error.what());  // the manager says only that it failed
      throw;
    }
  }

 protected:
  virtual std::unique_ptr<RunningNode> make(ros::NodeHandle& node,
                                            ros_utils::NodeParams& params) = 0;

 private:
  std::unique_ptr<RunningNode> node_;
};

class LeePositionControllerNodelet : public ControllerNodelet {
 protected:
  std::unique_ptr<RunningNode> make(ros::NodeHandle& node, ros_utils::NodeParams& params) override {
    const auto own = params.read<LeeNodeParams>();
    return std::make_unique<LeePositionControllerNode>(node, own.controller(), own.setpoints,
                                                       OdometryThread::kPublisher);
  }
};

class RollPitchYawrateThrustControllerNodelet : public ControllerNodelet {
 protected:
  std::unique_ptr<RunningNode> make(ros::NodeHandle& node, ros_utils::NodeParams& params) override {
    const auto own = params.read<RollPitchYawrateThrustNodeParams>();
    return std::make_unique<RollPitchYawrateThrustControllerNode>(node, own.controller(),
                                                                  OdometryThread::kPublisher);
  }
};

}  // namespace trident::control

PLUGINLIB_EXPORT_CLASS(trident::control::LeePositionControllerNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(trident::control::RollPitchYawrateThrustControllerNodelet, nodelet::Nodelet)
