// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/ros.h>
#include <slam_toolbox_msgs/Clear.h>
#include <slam_toolbox_msgs/ClearQueue.h>
#include <slam_toolbox_msgs/DeserializePoseGraph.h>
#include <slam_toolbox_msgs/LoopClosure.h>
#include <slam_toolbox_msgs/Pause.h>
#include <slam_toolbox_msgs/Reset.h>
#include <slam_toolbox_msgs/SaveMap.h>
#include <slam_toolbox_msgs/SerializePoseGraph.h>
#include <visualization_msgs/MarkerArray.h>

#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_estimation_ros/map_messages.h"
#include "trident_slam/slam_2d_abilities.h"
#include "trident_slam_ros/slam_node.h"
#include "trident_slam_ros/slam_parameters.h"
#include "trident_slam_ros/slam_programs.h"

namespace trident {
namespace {

namespace srv = slam_toolbox_msgs;
constexpr char kEnding[] = ".posegraph";

visualization_msgs::Marker marker(const std::string& frame, const std::string& name, int type) {
  visualization_msgs::Marker result;
  result.header.frame_id = frame;
  result.header.stamp = ros::Time::now();
  result.ns = name;
  result.type = type;
  result.pose.orientation.w = 1.0;
  result.color.a = 1.0F;
  return result;
}

geometry_msgs::Point point_of(const SE2& T_map_node) {
  geometry_msgs::Point point;
  point.x = T_map_node.p.x();
  point.y = T_map_node.p.y();
  return point;
}

visualization_msgs::MarkerArray graph_markers(const GraphView2d& graph, const std::string& frame) {
  visualization_msgs::Marker nodes = marker(frame, "nodes", visualization_msgs::Marker::POINTS);
  nodes.scale.x = nodes.scale.y = 0.1;
  nodes.color.r = 1.0F;
  for (const SE2& node : graph.nodes) nodes.points.push_back(point_of(node));
  visualization_msgs::Marker ways = marker(frame, "edges", visualization_msgs::Marker::LINE_LIST);
  ways.scale.x = 0.03;
  ways.color.b = 1.0F;
  visualization_msgs::Marker loops = ways;
  loops.ns = "loops";
  loops.color.b = 0.0F;
  loops.color.g = 0.8F;
  for (const GraphView2d::Edge& edge : graph.edges) {
    visualization_msgs::Marker& lines = edge.is_loop ? loops : ways;
    lines.points.push_back(point_of(graph.nodes[static_cast<std::size_t>(edge.from)]));
    lines.points.push_back(point_of(graph.nodes[static_cast<std::size_t>(edge.to)]));
  }
  visualization_msgs::MarkerArray array;
  array.markers = {nodes, ways, loops};
  return array;
}

template <class Ability, class Slam>
Ability& able(Slam& slam, const char* what) {
  auto* ability = dynamic_cast<Ability*>(&slam);
  if (ability == nullptr) throw Error(std::string("this method cannot ") + what);
  return *ability;
}

std::string session_file(const std::string& name) {
  if (name.empty()) throw Error("filename is empty, legal: a path without an ending");
  return name + kEnding;
}

/// The services of slam_toolbox around a SlamNode.
class Toolbox {
 public:
  Toolbox(const ros::NodeHandle& own, const SlamNodeOptions& options, SlamNode::MakeSlam make)
      : own_(own), map_frame_(options.map_frame), node_(own, options, std::move(make)) {
    serve<srv::Pause>("pause_new_measurements", [this](auto& /*request*/, auto& response) {
      node_.set_paused(!node_.is_paused());
      own_.setParam("paused_new_measurements", node_.is_paused());
      response.status = true;
    });
    serve<srv::ClearQueue>("clear_queue", [this](auto& /*request*/, auto& response) {
      node_.clear_queue();
      response.status = true;
    });
    serve<srv::Reset>("reset", [this](auto& request, auto& response) {
      node_.reset();
      node_.set_paused(request.pause_new_measurements);
      response.result = srv::Reset::Response::RESULT_SUCCESS;
    });
    serve<srv::SaveMap>("save_map", [this](auto& request, auto& /*response*/) {
      node_.save_map(request.name.data.empty() ? "map" : request.name.data);
    });
    serve<srv::LoopClosure>("manual_loop_closure", [this](auto& /*request*/, auto& /*response*/) {
      node_.with_slam([](Slam2d& slam) { slam.finish(); });
    });
    serve<srv::Clear>("clear_changes", [](auto& /*request*/, auto& /*response*/) {});
    serve_sessions();
    graph_publisher_ =
        own_.advertise<visualization_msgs::MarkerArray>("graph_visualization", 1, true);
    graph_timer_ = own_.createTimer(ros::Duration(std::max(options.map_update_interval, 0.1)),
                                    [this](const ros::TimerEvent&) { publish_graph(); });
    initial_pose_ = ros::NodeHandle().subscribe("initialpose", 1, &Toolbox::place, this);
    load_by_parameters();
  }

 private:
  // A request that cannot be met fails, and the log says why.
  template <class Service, class Answer>
  void serve(const std::string& name, const Answer& answer) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const boost::function<bool(Request&, Response&)> call = [name, answer](Request& request,
                                                                           Response& response) {
      try {
        answer(request, response);
        return true;
      } catch (const Error& error) {
        ROS_ERROR("%s: %s", name.c_str(), error.what());
        return false;
      }
    };
    services_.push_back(own_.advertiseService<Request, Response>(name, call));
  }

  void serve_sessions() {
    serve<srv::SerializePoseGraph>("serialize_map", [this](auto& request, auto& /*response*/) {
      const std::string file = session_file(request.filename);
      node_.with_slam(
          [&file](Slam2d& slam) { able<Slam2dSession>(slam, "keep sessions").save_session(file); });
    });
    serve<srv::DeserializePoseGraph>("deserialize_map", [this](auto& request, auto& /*response*/) {
      const auto& pose = request.initial_pose;
      load(request.filename, request.match_type, SE2::from_xy_yaw(pose.x, pose.y, pose.theta));
    });
  }

  void load(const std::string& name, int match_type, const SE2& T_map_base) {
    using Request = srv::DeserializePoseGraph::Request;
    SessionStart start = SessionStart::kFirstNode;
    if (match_type == Request::START_AT_GIVEN_POSE) {
      start = SessionStart::kGivenPose;
    } else if (match_type == Request::LOCALIZE_AT_POSE) {
      start = SessionStart::kLocalize;
    } else if (match_type != Request::START_AT_FIRST_NODE) {
      throw Error("match_type " + std::to_string(match_type) + ", legal: 1, 2, 3");
    }
    const std::string file = session_file(name);
    node_.with_slam([&](Slam2d& slam) {
      able<Slam2dSession>(slam, "read sessions").load_session(file, start, T_map_base);
    });
    node_.forget_correction();
  }

  void load_by_parameters() {
    std::string name;
    if (!own_.getParam("map_file_name", name) || name.empty()) return;
    std::vector<double> pose;
    const bool has_pose = own_.getParam("map_start_pose", pose);
    if (has_pose && pose.size() != 3) {
      throw Error("map_start_pose has " + std::to_string(pose.size()) +
                  " numbers, legal: [x, y, yaw]");
    }
    if (!has_pose) pose = {0.0, 0.0, 0.0};
    using Request = srv::DeserializePoseGraph::Request;
    load(name, has_pose ? Request::START_AT_GIVEN_POSE : Request::START_AT_FIRST_NODE,
         SE2::from_xy_yaw(pose[0], pose[1], pose[2]));
  }

  void place(const geometry_msgs::PoseWithCovarianceStamped& message) {
    try {
      const SE2 T_map_base = from_pose_message(message.pose.pose);
      node_.with_slam([&T_map_base](Slam2d& slam) {
        able<Slam2dPlaced>(slam, "be told where the robot is").set_pose(T_map_base);
      });
    } catch (const Error& error) {
      ROS_ERROR("initialpose: %s", error.what());
    }
  }

  void publish_graph() {
    if (graph_publisher_.getNumSubscribers() == 0) return;
    node_.with_slam([this](const Slam2d& slam) {
      const auto* graph = dynamic_cast<const Slam2dGraph*>(&slam);
      if (graph != nullptr)
        graph_publisher_.publish(graph_markers(graph->graph_view(), map_frame_));
    });
  }

  ros::NodeHandle own_;
  std::string map_frame_;
  SlamNode node_;
  std::vector<ros::ServiceServer> services_;
  ros::Publisher graph_publisher_;
  ros::Subscriber initial_pose_;
  ros::Timer graph_timer_;
};

}  // namespace

int run_slam_toolbox(int argc, char** argv, ToolboxMode mode) {
  ros::init(argc, argv, "slam_toolbox");
  try {
    const ros::NodeHandle own("~");
    SlamNodeOptions options;
    options.is_sync = mode != ToolboxMode::kAsync;
    read_options(own, options);
    GraphSlamOptions graph = read_graph_options(own);
    graph.is_asynchronous = mode == ToolboxMode::kAsync;
    if (mode == ToolboxMode::kLocalization) graph.mode = SlamMode::kLocalization;
    if (mode == ToolboxMode::kLifelong) graph.mode = SlamMode::kLifelong;
    const Toolbox toolbox(own, options, slam_maker(own, {"graph_slam_2d"}, graph));
    ros::spin();
  } catch (const std::exception& error) {
    std::cerr << ros::this_node::getName() << ": " << error.what() << std::endl;
    return 1;
  }
  return 0;
}

}  // namespace trident
