// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <interactive_markers/interactive_marker_server.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <slam_toolbox_msgs/AddSubmap.h>
#include <slam_toolbox_msgs/MergeMaps.h>
#include <slam_toolbox_msgs/SerializePoseGraph.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <memory>
#include <string>
#include <vector>

#include "trident_base/string_util.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_ros/message_checks.h"
#include "trident_ros/refusals.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam_ros/graph_editor.h"
#include "trident_slam_ros/run_program.h"
#include "trident_slam_ros/service_list.h"
#include "trident_slam_ros/slam_parameters.h"
#include "trident_slam_ros/slam_programs.h"

namespace trident::slam {
namespace {

namespace srv = slam_toolbox_msgs;
constexpr char kMethod[] = "graph_slam_2d";
constexpr char kMapFrame[] = "map";
constexpr double kMarkerDiameter = 2.4;  // [m]
constexpr double kFarthestMarker = 1e5;  // [m]

/// A session, and where a user has put it.
struct Submap {
  std::string file;
  std::string frame;  ///< map_1, map_2 ...: of its own coordinates
  SE2 T_submap_marker;
  SE2 T_map_submap;
  ros::Publisher publisher;
};

SE2 middle_of(const OccupancyGrid& map) {
  const Eigen::Vector2d middle(0.5 * map.resolution * map.width, 0.5 * map.resolution * map.height);
  const Eigen::Vector2d p = map.T_map_origin * middle;
  return SE2::from_xy_yaw(p.x(), p.y(), 0.0);
}

/// Sessions that are aligned with each other by hand (interactive markers, namespace
/// merge_maps_tool), and become one map.
class MapMerger {
 public:
  explicit MapMerger(const GraphSlamOptions& options)
      : options_(options),
        handle_("map_merging"),
        markers_("merge_maps_tool"),
        map_publisher_(ros::NodeHandle().advertise<nav_msgs::OccupancyGrid>("map", 1, true)),
        services_(handle_) {
    services_.serve<srv::AddSubmap>("add_submap", [this](auto& request, auto& /*response*/) {
      add(session_file(request.filename));
    });
    services_.serve<srv::MergeMaps>("merge_submaps",
                                    [this](auto& /*request*/, auto& /*response*/) { merge(); });
    services_.serve<srv::SerializePoseGraph>(
        "serialize_map", [this](auto& request, auto& /*response*/) {
          if (!merged_) throw Error("there is no merged map yet: call merge_submaps");
          merged_->save_session(session_file(request.filename));
        });
  }

 private:
  void add(const std::string& file) {
    GraphSlam2d session(options_);
    session.load_session(file);
    const OccupancyGrid map = session.map();
    Submap submap;
    submap.file = file;
    submap.frame = "map_" + std::to_string(submaps_.size() + 1);
    submap.T_submap_marker = middle_of(map);
    submap.publisher = ros::NodeHandle().advertise<nav_msgs::OccupancyGrid>(submap.frame, 1, true);
    publish(submap.publisher, submap.frame, map);
    const std::size_t index = submaps_.size();
    submaps_.push_back(submap);
    place(index, submap.T_submap_marker);
    markers_.insert(movable_marker(std::to_string(index + 1), kMapFrame, submap.T_submap_marker,
                                   kMarkerDiameter),
                    [this, index](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& f) {
                      follow(index, *f);
                    });
    markers_.applyChanges();
    ROS_INFO("%s is on topic %s", file.c_str(), submap.frame.c_str());
  }

  static void publish(const ros::Publisher& publisher, const std::string& frame,
                      const OccupancyGrid& map) {
    std_msgs::Header header;
    header.frame_id = frame;
    header.stamp = ros::Time::now();
    publisher.publish(maps::to_map_message(map, header));
  }

  void follow(std::size_t index, const visualization_msgs::InteractiveMarkerFeedback& feedback) {
    if (feedback.event_type != visualization_msgs::InteractiveMarkerFeedback::POSE_UPDATE) return;
    try {
      const SE2 T_map_marker = maps::from_pose_message(feedback.pose);
      if (!(T_map_marker.p.norm() <= kFarthestMarker)) {
        throw Error("it is " + number_text(T_map_marker.p.norm()) + " m away, legal: up to " +
                    number_text(kFarthestMarker) + " m");
      }
      place(index, T_map_marker);
      markers_.applyChanges();  // for other viewers
    } catch (const Error& error) {
      refusals_.note("marker refused",
                     "marker '" + ros_utils::quoted(feedback.marker_name) + "': " + error.what());
    }
  }

  void place(std::size_t index, const SE2& T_map_marker) {
    Submap& submap = submaps_[index];
    submap.T_map_submap = T_map_marker * submap.T_submap_marker.inverse();
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = kMapFrame;
    transform.header.stamp = ros::Time::now();
    transform.child_frame_id = submap.frame;
    const geometry_msgs::Pose pose = maps::to_pose_message(submap.T_map_submap);
    transform.transform.translation.x = pose.position.x;
    transform.transform.translation.y = pose.position.y;
    transform.transform.rotation = pose.orientation;
    broadcaster_.sendTransform(transform);
  }

  void merge() {
    if (submaps_.empty()) throw Error("there is nothing to merge: call add_submap");
    auto merged = std::make_unique<GraphSlam2d>(options_);
    for (const Submap& submap : submaps_) {
      const int loops = merged->append_session(submap.file, submap.T_map_submap);
      if (&submap == &submaps_.front()) continue;
      if (loops > 0) {
        ROS_INFO("%s: found in the others, %d loops", submap.frame.c_str(), loops);
      } else {
        ROS_WARN("%s: no place of it was found in the others; it stays where it was put",
                 submap.frame.c_str());
      }
    }
    merged->finish();
    merged_ = std::move(merged);
    publish(map_publisher_, kMapFrame, merged_->map());
  }

  GraphSlamOptions options_;
  ros::NodeHandle handle_;
  ros_utils::Refusals refusals_{handle_};
  interactive_markers::InteractiveMarkerServer markers_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher map_publisher_;
  std::vector<Submap> submaps_;
  std::unique_ptr<GraphSlam2d> merged_;
  ServiceList services_;
};

void run() {
  const ros::NodeHandle own("~");  // ROS ends with the last handle
  ros_utils::NodeParams params(own);
  SlamMethod method(params, kMethod);
  if (method.name() != kMethod) {
    throw Error("parameter " + params.name_space() + "/method is " + method.name() + ", must be " +
                kMethod);
  }
  set_node_defaults(method);
  const MapMerger merger(method.params<GraphSlamOptions>());
  ros::spin();
}

}  // namespace

int run_merge_maps(int argc, char** argv) {
  return run_program(argc, argv, "merge_maps_kinematic", run);
}

}  // namespace trident::slam
