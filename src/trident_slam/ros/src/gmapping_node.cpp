// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>
#include <std_msgs/Float64.h>

#include <vector>

#include "trident_slam/particle_slam_2d.h"
#include "trident_slam_ros/gmapping_params.h"
#include "trident_slam_ros/run_program.h"
#include "trident_slam_ros/slam_node.h"
#include "trident_slam_ros/slam_parameters.h"
#include "trident_slam_ros/slam_programs.h"

namespace trident::slam {
namespace {

constexpr double kEntropyPeriodS = 1.0;
constexpr char kUsualMethod[] = "particle_slam_2d";

/// gmapping's names for what graph_slam_2d calls otherwise. Its maxUrange is its maxRange where it
/// is not set.
const std::vector<ParameterAlias>& aliases() {
  static const std::vector<ParameterAlias> list = {{"maxUrange", "maxRange"},
                                                   {"resolution", "delta"},
                                                   {"minimum_travel_distance", "linearUpdate"},
                                                   {"minimum_travel_heading", "angularUpdate"},
                                                   {"max_laser_range", "maxUrange"},
                                                   {"max_laser_range", "maxRange"}};
  return list;
}

/// Parameters of gmapping's scan matcher, which searches in steps; of maps that do not grow; of a
/// map that counts hits.
void accept_upstream_names(ros_utils::NodeParams& params) {
  params.accept_without_effect({"sigma", "kernelSize", "lstep", "astep", "iterations", "lsigma",
                                "llsamplestep", "llsamplerange", "lasamplerange", "lasamplestep",
                                "xmin", "ymin", "xmax", "ymax", "occ_thresh"});
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
  ros_utils::NodeParams params(own);
  const SlamNodeOptions options = params.read<GmappingParams>().options;
  SlamMethod method(params, kUsualMethod, aliases());
  set_node_defaults(method);
  method.set("is_asynchronous", "true");
  accept_upstream_names(params);
  params.log_warnings();
  SlamNode node(ros::NodeHandle(), options, method.maker());
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
