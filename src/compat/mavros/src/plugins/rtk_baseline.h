// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mavros_msgs/RTKBaseline.h>
#include <ros/time.h>

namespace trident::mavros {

/// GPS_RTK or GPS2_RTK as a message of ROS.
template <class Payload>
mavros_msgs::RTKBaseline to_rtk(const Payload& p) {
  mavros_msgs::RTKBaseline message;
  message.header.stamp = ros::Time::now();
  message.time_last_baseline_ms = p.time_last_baseline_ms;
  message.rtk_receiver_id = p.rtk_receiver_id;
  message.wn = p.wn;
  message.tow = p.tow;
  message.rtk_health = p.rtk_health;
  message.rtk_rate = p.rtk_rate;
  message.nsats = p.nsats;
  message.baseline_coords_type = p.baseline_coords_type;
  message.baseline_a_mm = p.baseline_a_mm;
  message.baseline_b_mm = p.baseline_b_mm;
  message.baseline_c_mm = p.baseline_c_mm;
  message.accuracy = p.accuracy;
  message.iar_num_hypotheses = p.iar_num_hypotheses;
  return message;
}

}  // namespace trident::mavros
