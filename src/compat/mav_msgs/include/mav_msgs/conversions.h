// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <Eigen/StdVector>

#include "mav_msgs/common.h"
#include "mav_msgs/conversions_from_msg.h"
#include "mav_msgs/conversions_to_msg.h"
#include "mav_msgs/default_values.h"
#include "mav_msgs/eigen_mav_msgs.h"
#include "mav_msgs/flat_state.h"
