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
#include <slam_toolbox_msgs/ToggleInteractive.h>
#include <std_srvs/Empty.h>
#include <visualization_msgs/MarkerArray.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_slam/slam_2d_capabilities.h"
#include "trident_slam_ros/graph_editor.h"
#include "trident_slam_ros/run_program.h"
#include "trident_slam_ros/service_list.h"
#include "trident_slam_ros/slam_node.h"
#include "trident_slam_ros/slam_parameters.h"
#include "trident_slam_ros/slam_programs.h"
#include "trident_slam_ros/toolbox_parameters.h"

namespace trident::slam {
namespace {

namespace srv = slam_toolbox_msgs;

template <class Ability, class Slam>
Ability& able(Slam& slam, const char* what) {
  auto* ability = dynamic_cast<Ability*>(&slam);
  if (ability == nullptr) throw Error(std::string("this method cannot ") + what);
  return *ability;
}

ros::NodeHandle handle_of(ros::NodeHandle handle, ros::CallbackQueue* queue) {
  handle.setCallbackQueue(queue);
  return handle;
}

/// The services of slam_toolbox around a SlamNode.
class Toolbox {
 public:
  /// `can_edit`: interactive mode is allowed.
  Toolbox(const ros::NodeHandle& own, const SlamNodeOptions& options, SlamNode::MakeSlam make,
          bool can_edit, const ToolboxParams& start)
      : own_(own),
        map_frame_(options.map_frame),
        can_edit_(can_edit),
        node_(own, options, std::move(make)),
        editor_(own, node_, options.map_frame),
        services_(handle_of(own, node_.slow_queue()),
                  [this](const std::string& text) { node_.count_problem(text); }) {
    own_.setCallbackQueue(node_.slow_queue());
    services_.serve<srv::Pause>("pause_new_measurements",
                                [this](auto& /*request*/, auto& response) {
                                  node_.set_paused(!node_.is_paused());
                                  own_.setParam("paused_new_measurements", node_.is_paused());
                                  response.status = true;
                                });
    services_.serve<srv::ClearQueue>("clear_queue", [this](auto& /*request*/, auto& response) {
      node_.clear_queue();
      response.status = true;
    });
    services_.serve<srv::Reset>("reset", [this](auto& request, auto& response) {
      node_.reset();
      node_.set_paused(request.pause_new_measurements);
      response.result = srv::Reset::Response::RESULT_SUCCESS;
    });
    services_.serve<srv::SaveMap>("save_map", [this](auto& request, auto& /*response*/) {
      const std::string stem = request.name.data.empty() ? "map" : request.name.data;
      node_.save_map(stem);
      ROS_INFO("%s.pgm and .yaml are written", std::filesystem::absolute(stem).c_str());
    });
    serve_sessions();
    serve_corrections();
    graph_publisher_ =
        own_.advertise<visualization_msgs::MarkerArray>("graph_visualization", 1, true);
    graph_timer_ = own_.createTimer(ros::Duration(std::max(options.map_update_interval, 0.1)),
                                    [this](const ros::TimerEvent&) { publish_graph(); });
    initial_pose_ = ros::NodeHandle().subscribe("initialpose", 1, &Toolbox::place, this);
    load_by_parameters(start);
  }

  void run() { node_.run(); }

 private:
  void serve_sessions() {
    services_.serve<srv::SerializePoseGraph>(
        "serialize_map", [this](auto& request, auto& /*response*/) {
          const std::string file = session_file(request.filename);
          node_.save_session(file);
        });
    services_.serve<srv::DeserializePoseGraph>(
        "deserialize_map", [this](auto& request, auto& /*response*/) {
          const auto& pose = request.initial_pose;
          load(request.filename, request.match_type, SE2::from_xy_yaw(pose.x, pose.y, pose.theta));
        });
  }

  void serve_corrections() {
    services_.serve<srv::ToggleInteractive>("toggle_interactive_mode",
                                            [this](auto& /*request*/, auto& /*response*/) {
                                              if (!can_edit_) {
                                                throw Error(
                                                    "not while localizing, nor without parameter "
                                                    "enable_interactive_mode");
                                              }
                                              editor_.toggle();
                                              publish_graph();
                                            });
    services_.serve<srv::LoopClosure>("manual_loop_closure",
                                      [this](auto& /*request*/, auto& /*response*/) {
                                        editor_.apply();
                                        publish_graph();
                                      });
    services_.serve<srv::Clear>("clear_changes",
                                [this](auto& /*request*/, auto& /*response*/) { editor_.clear(); });
    services_.serve<std_srvs::Empty>(
        "clear_localization_buffer", [this](auto& /*request*/, auto& /*response*/) {
          node_.with_slam([](Slam2d& slam) {
            able<Slam2dLocalizing>(slam, "keep scans to localize with").clear_localization_buffer();
          });
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

  void load_by_parameters(const ToolboxParams& start) {
    if (start.map_file_name.empty()) return;
    const bool is_at_dock = !start.map_start_pose && start.map_start_at_dock.value_or(true);
    const std::array<double, 3> pose = start.map_start_pose.value_or(std::array<double, 3>{});
    using Request = srv::DeserializePoseGraph::Request;
    load(start.map_file_name,
         is_at_dock ? Request::START_AT_FIRST_NODE : Request::START_AT_GIVEN_POSE,
         SE2::from_xy_yaw(pose[0], pose[1], pose[2]));
  }

  void place(const geometry_msgs::PoseWithCovarianceStamped& message) {
    try {
      const SE2 T_map_base = maps::from_pose_message(message.pose.pose);
      node_.with_slam([&T_map_base](Slam2d& slam) {
        able<PoseInitializable>(slam, "accept an initial pose").set_pose(T_map_base);
      });
    } catch (const Error& error) {
      node_.report(std::string("initialpose: ") + error.what());
    }
  }

  void publish_graph() {
    if (graph_publisher_.getNumSubscribers() == 0) return;
    const auto view = node_.with_slam([](const Slam2d& slam) {
      const auto* graph = dynamic_cast<const Slam2dGraph*>(&slam);
      return graph == nullptr ? std::nullopt : std::optional<GraphView2d>(graph->graph_view());
    });
    if (view) graph_publisher_.publish(graph_markers(*view, map_frame_));
  }

  ros::NodeHandle own_;
  std::string map_frame_;
  bool can_edit_;
  SlamNode node_;
  GraphEditor editor_;
  ServiceList services_;
  ros::Publisher graph_publisher_;
  ros::Subscriber initial_pose_;
  ros::Timer graph_timer_;
};

void log_debug() {
  if (ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Debug)) {
    ros::console::notifyLoggerLevelsChanged();
  }
}

void run(ToolboxMode mode) {
  const ros::NodeHandle own("~");
  ros_utils::NodeParams params(own);
  auto options = params.read<SlamNodeOptions>();
  options.is_sync = mode != ToolboxMode::kAsync;
  const auto toolbox_params = params.read<ToolboxParams>();
  options.map_topic = toolbox_params.map_name;
  SlamMethod method(params, "graph_slam_2d");
  set_node_defaults(method);
  method.set("is_asynchronous", mode == ToolboxMode::kAsync ? "true" : "false");
  if (mode == ToolboxMode::kLocalization) method.set("mode", "localization");
  if (mode == ToolboxMode::kLifelong) method.set("mode", "lifelong");
  method.set_solver(read_solver(params, toolbox_params.solver_plugin));
  accept_toolbox_names(params);
  params.log_warnings();
  if (toolbox_params.debug_logging) log_debug();
  const bool can_edit =
      method.text("mode") != "localization" && toolbox_params.enable_interactive_mode;
  Toolbox toolbox(own, options, method.maker(), can_edit, toolbox_params);
  toolbox.run();
}

}  // namespace

int run_slam_toolbox(int argc, char** argv, ToolboxMode mode) {
  return run_program(argc, argv, "slam_toolbox", [mode] { run(mode); });
}

}  // namespace trident::slam
