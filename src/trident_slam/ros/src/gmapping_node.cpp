// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>
#include <std_msgs/Float64.h>

#include "trident_slam/particle_slam_2d.h"
#include "trident_slam_ros/parameter_names.h"
#include "trident_slam_ros/run_program.h"
#include "trident_slam_ros/slam_node.h"
#include "trident_slam_ros/slam_parameters.h"
#include "trident_slam_ros/slam_programs.h"

namespace trident::slam {
namespace {

constexpr double kEntropyPeriodS = 1.0;
constexpr char kUsualMethod[] = "particle_slam_2d";

/// Of gmapping's scan matcher, which searches in steps; of maps that do not grow; of a map that
/// counts hits.
const ParameterNames& upstream_parameters() {
  static const ParameterNames names = {
      "sigma",  "kernelSize",   "lstep",         "astep",         "iterations",
      "lsigma", "llsamplestep", "llsamplerange", "lasamplerange", "lasamplestep",
      "xmin",   "ymin",         "xmax",          "ymax",          "occ_thresh"};
  return names;
}

void tell_unused_parameters(const ros::NodeHandle& own) {
  ParameterNames used = field_names<ParticleSlamParams>();
  const ParameterNames of_node = slam_node_parameters();
  used.insert(used.end(), of_node.begin(), of_node.end());
  used.insert(used.end(), {"method", "config_file", "maxRange", "tf_delay"});
  tell_unused(own, used, upstream_parameters());
}

void publish_entropy(SlamNode& node, const ros::Publisher& publisher) {
  node.with_slam([&publisher](Slam2d& slam) {
    const auto* particles = dynamic_cast<const ParticleSlam2d*>(&slam);
    if (particles == nullptr) return;
    std_msgs::Float64 message;
    message.data = particles->entropy();
    publisher.publish(message);
  });
}

void run() {
  const ros::NodeHandle own("~");
  SlamNodeOptions options;
  options.base_frame = "base_link";
  options.transform_publish_period = 0.05;
  read_options(own, options);
  own.getParam("tf_delay", options.tf_delay);
  // What gmapping calls otherwise.
  GraphSlamOptions graph;
  own.getParam("delta", graph.resolution);
  own.getParam("linearUpdate", graph.minimum_travel_distance);
  own.getParam("angularUpdate", graph.minimum_travel_heading);
  double reach = 0.0;  // gmapping's maxUrange is its maxRange where it is not given
  if (!own.hasParam("maxUrange") && own.getParam("maxRange", reach)) {
    own.setParam("maxUrange", reach);
  }
  own.getParam("maxUrange", graph.max_laser_range);
  read_graph_file(own, kUsualMethod, graph);
  graph.is_asynchronous = true;
  tell_unused_parameters(own);
  graph.validate();
  SlamNode node(ros::NodeHandle(), options, slam_maker(own, kUsualMethod, graph));
  ros::NodeHandle handle("~");
  const ros::Publisher publisher = handle.advertise<std_msgs::Float64>("entropy", 1, true);
  const ros::Timer timer =
      handle.createTimer(ros::Duration(kEntropyPeriodS),
                         [&](const ros::TimerEvent&) { publish_entropy(node, publisher); });
  node.run();
}

}  // namespace

int run_gmapping(int argc, char** argv) { return run_program(argc, argv, "slam_gmapping", run); }

}  // namespace trident::slam
