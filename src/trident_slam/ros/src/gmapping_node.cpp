// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <exception>
#include <iostream>

#include "trident_slam_ros/slam_node.h"
#include "trident_slam_ros/slam_parameters.h"
#include "trident_slam_ros/slam_programs.h"

namespace trident {

int run_gmapping(int argc, char** argv) {
  ros::init(argc, argv, "slam_gmapping");
  try {
    const ros::NodeHandle own("~");
    SlamNodeOptions options;
    options.base_frame = "base_link";
    options.transform_publish_period = 0.05;
    read_options(own, options);
    own.getParam("tf_delay", options.transform_timeout);
    // What gmapping calls otherwise.
    GraphSlamOptions graph;
    own.getParam("delta", graph.resolution);
    own.getParam("linearUpdate", graph.minimum_travel_distance);
    own.getParam("angularUpdate", graph.minimum_travel_heading);
    if (!own.getParam("maxUrange", graph.max_laser_range)) {
      own.getParam("maxRange", graph.max_laser_range);
    }
    graph.is_asynchronous = true;
    graph.validate();
    const SlamNode node(ros::NodeHandle(), options, slam_maker(own, {"particle_slam_2d"}, graph));
    ros::spin();
  } catch (const std::exception& error) {
    std::cerr << ros::this_node::getName() << ": " << error.what() << std::endl;
    return 1;
  }
  return 0;
}

}  // namespace trident
