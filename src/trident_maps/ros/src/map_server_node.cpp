// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps_ros/map_server_node.h"

#include <cstdio>

#include "trident_maps/map_file.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_ros/message_checks.h"

namespace trident::maps {
namespace {

std::uint8_t code_of(MapFileError::Kind kind) {
  switch (kind) {
    case MapFileError::Kind::kNoSuchFile:
      return nav_msgs::LoadMap::Response::RESULT_MAP_DOES_NOT_EXIST;
    case MapFileError::Kind::kBadMetadata:
      return nav_msgs::LoadMap::Response::RESULT_INVALID_MAP_METADATA;
    default:
      return nav_msgs::LoadMap::Response::RESULT_INVALID_MAP_DATA;
  }
}

}  // namespace

MapServerNode::MapServerNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
                             const std::string& yaml_path)
    : frame_(private_node.param<std::string>("frame_id", "map")),
      map_publisher_(node.advertise<nav_msgs::OccupancyGrid>("map", 1, true)),
      metadata_publisher_(node.advertise<nav_msgs::MapMetaData>("map_metadata", 1, true)),
      diagnostics_publisher_(
          node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1, true)) {
  load(yaml_path);
  // Boost's function objects of roscpp take the callback's type from these two.
  const boost::function<bool(nav_msgs::GetMap::Request&, nav_msgs::GetMap::Response&)> give =
      [this](nav_msgs::GetMap::Request&, nav_msgs::GetMap::Response& response) {
        response.map = map_;
        return true;
      };
  static_map_ = node.advertiseService("static_map", give);
  change_map_ = node.advertiseService("change_map", &MapServerNode::on_change_map, this);
}

void MapServerNode::load(const std::string& yaml_path) {
  std_msgs::Header header;
  header.frame_id = frame_;
  header.stamp = ros::Time::now();
  map_ = to_map_message(load_map(yaml_path), header);
  ROS_INFO("map %s: %u x %u cells of %g m", yaml_path.c_str(), map_.info.width, map_.info.height,
           static_cast<double>(map_.info.resolution));
  map_publisher_.publish(map_);
  metadata_publisher_.publish(map_.info);
}

/// The service succeeds as a call in any case; its result says whether the file could be used. A
/// file that cannot be used leaves the present map in place, so that who follows it is not
/// stranded.
bool MapServerNode::on_change_map(nav_msgs::LoadMap::Request& request,
                                  nav_msgs::LoadMap::Response& response) {
  response.result = nav_msgs::LoadMap::Response::RESULT_SUCCESS;
  try {
    load(request.map_url);
    response.map = map_;
  } catch (const MapFileError& error) {
    ROS_ERROR("%s",
              ros_utils::quoted(std::string("change_map: ") + error.what() + "; the last map stays")
                  .c_str());
    response.result = code_of(error.kind());
    problems_.note("change_map", ros_utils::quoted(error.what()));
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp = ros::Time::now();
    problems_.add_to(array, "map_server");
    diagnostics_publisher_.publish(array);
  }
  return true;
}

/// A first map that cannot be loaded ends the process: nobody could be served without it.
int map_server_main(int argc, char** argv) {
  ros::init(argc, argv, "map_server", ros::init_options::AnonymousName);
  if (argc != 2) {
    std::fputs("usage: map_server MAP.yaml\n", stderr);
    return 2;
  }
  ros::NodeHandle node;
  try {
    const MapServerNode server(node, ros::NodeHandle("~"), argv[1]);
    ros::spin();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::maps
