// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gazebo_msgs/SpawnModel.h>
#include <mav_msgs/conversions.h>
#include <mav_msgs/default_topics.h>
#include <rotors_comm/WindSpeed.h>

#include <iostream>

// Prints the set-point that a controller would read back from a one-point trajectory.
int main() {
  trajectory_msgs::MultiDOFJointTrajectory msg;
  mav_msgs::msgMultiDofJointTrajectoryFromPositionYaw(Eigen::Vector3d(1, 2, 3), 0.5, &msg);
  mav_msgs::EigenTrajectoryPointDeque commands;
  mav_msgs::eigenTrajectoryPointDequeFromMsg(msg, &commands);
  gazebo_msgs::SpawnModel spawn;
  spawn.request.model_name = "overlay";
  rotors_comm::WindSpeed wind;
  wind.velocity.x = 4.0;
  std::cout << mav_msgs::default_topics::COMMAND_TRAJECTORY << ' '
            << commands.front().position_W.transpose() << ' ' << commands.front().getYaw() << ' '
            << spawn.request.model_name << ' ' << wind.velocity.x << '\n';
}
