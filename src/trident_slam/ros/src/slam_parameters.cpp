// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_parameters.h"

#include <XmlRpcValue.h>

#include <algorithm>
#include <sstream>

#include "trident_base/string_util.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/hector_slam_2d.h"
#include "trident_slam/particle_slam_2d.h"
#include "trident_slam/slam_2d_abilities.h"
#include "trident_slam_ros/parameter_names.h"

namespace trident {
namespace {

using XmlRpc::XmlRpcValue;

constexpr char kGraphSlam[] = "graph_slam_2d";

/// graph_slam_2d with what the node asks for.
class GraphSlamOfNode : public GraphSlam2d,
                        public Slam2dSession,
                        public Slam2dMapSnapshot,
                        public Slam2dPlaced,
                        public Slam2dGraph,
                        public Slam2dEditable,
                        public Slam2dLocalizing {
 public:
  GraphSlamOfNode(const GraphSlamOptions& options, PoseGraphSolverMaker solver)
      : GraphSlam2d(options, std::move(solver)), is_asynchronous_(options.is_asynchronous) {}

  /// Scans do not wait for it in asynchronous mode.
  void finish() override { is_asynchronous_ ? realign() : GraphSlam2d::finish(); }
  std::function<OccupancyGrid()> map_snapshot() const override {
    return GraphSlam2d::map_snapshot();
  }
  std::function<void(const std::string&)> session_snapshot() const override {
    return GraphSlam2d::session_snapshot();
  }
  void save_session(const std::string& file) const override { GraphSlam2d::save_session(file); }
  void load_session(const std::string& file, SessionStart start, const SE2& T_map_base) override {
    if (start != SessionStart::kFirstNode) {
      GraphSlam2d::load_session(file, T_map_base);
      if (start == SessionStart::kLocalize) set_mode(SlamMode::kLocalization);
      return;
    }
    GraphSlam2d::load_session(file);
    const std::vector<SE2> poses = keyframe_poses();
    if (!poses.empty()) GraphSlam2d::set_pose(poses.front());
  }
  void set_pose(const SE2& T_map_base) override { GraphSlam2d::set_pose(T_map_base); }
  void clear_localization_buffer() override { GraphSlam2d::clear_localization_buffer(); }
  GraphView2d graph_view() const override {
    GraphView2d view;
    view.nodes = keyframe_poses();
    for (const GraphSlamEdge& edge : edges()) {
      view.edges.push_back({edge.from, edge.to, edge.is_loop});
    }
    return view;
  }
  void write_g2o(const std::string& file) const override { save_g2o(file); }
  std::vector<Eigen::Vector2f> node_points(int node) const override {
    return keyframe_points(node);
  }
  std::vector<int> move_nodes(const std::map<int, SE2>& T_map_base) override {
    return move_keyframes(T_map_base);
  }

 private:
  bool is_asynchronous_;
};

ConfigNode to_config(XmlRpcValue& value) {
  ConfigNode node;
  if (value.getType() == XmlRpcValue::TypeArray) {
    node.kind = ConfigNode::Kind::kSequence;
    for (int i = 0; i < value.size(); ++i) node.items.push_back(to_config(value[i]));
    return node;
  }
  node.kind = ConfigNode::Kind::kScalar;
  if (value.getType() == XmlRpcValue::TypeString) {
    node.scalar = static_cast<std::string>(value);
    node.quoted = true;
  } else if (value.getType() == XmlRpcValue::TypeBoolean) {
    node.scalar = static_cast<bool>(value) ? "true" : "false";
  } else if (value.getType() == XmlRpcValue::TypeInt) {
    node.scalar = std::to_string(static_cast<int>(value));
  } else if (value.getType() == XmlRpcValue::TypeDouble) {
    node.scalar = number_text(static_cast<double>(value));
  } else {
    node.kind = ConfigNode::Kind::kMap;  // no field is one: refused by name
  }
  return node;
}

/// Those fields of a parameter struct that the node has parameters of the same name for.
template <class Params>
Params read_params(const ros::NodeHandle& private_handle) {
  ConfigNode known;
  known.kind = ConfigNode::Kind::kMap;
  for (const std::string& name : field_names<Params>()) {
    XmlRpcValue value;
    if (!private_handle.getParam(name, value)) continue;
    known.keys.push_back(name);
    known.key_lines.push_back(0);
    known.items.push_back(to_config(value));
  }
  return load_config_node<Params>(known, "parameters of " + private_handle.getNamespace());
}

/// hector_slam_2d that a user can set in its place.
class HectorSlamOfNode : public HectorSlam2d, public Slam2dPlaced {
 public:
  using HectorSlam2d::HectorSlam2d;
  void set_pose(const SE2& T_map_base) override { HectorSlam2d::set_pose(T_map_base); }
};

}  // namespace

GraphSlamOptions read_graph_options(const ros::NodeHandle& private_handle) {
  auto options = read_params<GraphSlamOptions>(private_handle);
  // A node runs for as long as it likes, and nobody asks it for the places of all scans.
  if (!private_handle.hasParam("keep_scans")) options.keep_scans = false;
  return options;
}

std::function<std::unique_ptr<Slam2d>()> slam_maker(const ros::NodeHandle& private_handle,
                                                    const std::vector<std::string>& usual,
                                                    const GraphSlamOptions& graph,
                                                    const PoseGraphSolverMaker& solver) {
  auto registry = std::make_shared<Registry<Slam2dFactory>>("SLAM method");
  register_builtin_slam_2d(*registry);
  const auto first = std::find_if(usual.begin(), usual.end(), [&registry](const std::string& name) {
    return registry->find(name) != nullptr;
  });
  std::string method = first == usual.end() ? kGraphSlam : *first;
  std::string config_file;
  private_handle.getParam("method", method);
  private_handle.getParam("config_file", config_file);
  registry->get(method);
  if (method == kGraphSlam && config_file.empty()) {
    return [graph, solver] { return std::make_unique<GraphSlamOfNode>(graph, solver); };
  }
  if (method == "particle_slam_2d" && config_file.empty()) {
    const auto params = read_params<ParticleSlamParams>(private_handle);
    return [params] { return std::make_unique<ParticleSlam2d>(params); };
  }
  if (method == "hector_slam_2d" && config_file.empty()) {
    const auto params = read_params<HectorSlamParams>(private_handle);
    return [params] { return std::make_unique<HectorSlamOfNode>(params); };
  }
  return [registry, method, config_file] { return registry->get(method)(config_file); };
}

}  // namespace trident
