// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/costmap_node.h"

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <algorithm>

#include "trident_base/error.h"
#include "trident_nav/core/footprint.h"
#include "trident_nav/costmap/published_cost.h"
#include "trident_nav_ros/frames.h"

namespace trident::nav {
namespace {

// Of a costmap's parameters, what is read at the start alone.
constexpr const char* kFixedParams[] = {"global_frame",    "robot_base_frame",
                                        "rolling_window",  "track_unknown_space",
                                        "footprint_topic", "published_footprint_topic"};

CellBox joined(const CellBox& a, const CellBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

bool is_same(const Footprint& a, const Footprint& b) {
  return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const Point2& p, const Point2& q) { return p.x == q.x && p.y == q.y; });
}

}  // namespace

Registry<LayerType> builtin_layer_types() {
  Registry<LayerType> registry("costmap layer");
  register_builtin_layers(registry);
  return registry;
}

CostmapNode::CostmapNode(const ros::NodeHandle& node, const CostmapConfig& config,
                         const tf2::BufferCore& buffer, ros_utils::Refusals& refusals)
    : node_(node),
      buffer_(buffer),
      costmap_(
          std::make_unique<Costmap>(config.params, make_layers(config, builtin_layer_types()))),
      frame_(frame_name(config.params.global_frame)),
      base_frame_(frame_name(config.params.robot_base_frame)),
      layers_(config.layers),
      inputs_(root_, *costmap_, buffer, refusals) {
  note_params(config.params);
  topics_.all = node_.advertise<nav_msgs::OccupancyGrid>("costmap", 1, true);
  topics_.parts = node_.advertise<map_msgs::OccupancyGridUpdate>("costmap_updates", 1);
  hear_footprints(config.params.footprint_topic, refusals);
  topics_.footprint =
      node_.advertise<geometry_msgs::PolygonStamped>(config.params.published_footprint_topic, 1);
  topics_.voxels = std::make_unique<VoxelTopics>(node_, *costmap_, frame_);
  inputs_.set_observation_listener(
      [this](const BeamSource& source, const Observation& observation) {
        topics_.voxels->note(source, observation);
      });
}

/// Before the footprint is advertised: with upstream's names both have one topic and are of two
/// types, and roscpp refuses a subscription to what the process itself publishes as another type.
void CostmapNode::hear_footprints(const std::string& topic, ros_utils::Refusals& refusals) {
  topics_.footprint_input = node_.subscribe<geometry_msgs::Polygon>(
      topic, 1, [this, &refusals](const geometry_msgs::PolygonConstPtr& polygon) {
        take_footprint(*polygon, refusals);
      });
}

/// Without the padding, as costmap_2d takes it. The same one again changes nothing.
void CostmapNode::take_footprint(const geometry_msgs::Polygon& polygon,
                                 ros_utils::Refusals& refusals) {
  std::vector<Point2> corners;
  for (const geometry_msgs::Point32& p : polygon.points) {
    corners.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
  }
  std::function<void()> on_footprint;
  try {
    const std::lock_guard lock(mutex_);
    on_footprint = topics_.on_footprint;
    const Footprint next =
        padded_footprint(polygon_footprint(corners), costmap_->params().footprint_padding);
    if (is_same(next, costmap_->footprint())) return;
    costmap_->set_footprint(next);
  } catch (const Error& error) {
    refusals.note("footprint",
                  "a footprint for " + node_.getNamespace() + " is not used: " + error.what());
    return;
  }
  if (on_footprint) on_footprint();
}

void CostmapNode::note_params(const CostmapParams& params) {
  constexpr double kSlow_s = 0.2;
  update_period_s_ = params.update_frequency > 0.0 ? 1.0 / params.update_frequency : kSlow_s;
  transform_tolerance_s_ = params.transform_tolerance;
}

std::vector<ConfigField> CostmapNode::live_fields() {
  const std::lock_guard lock(mutex_);
  std::vector<ConfigField> fields = config_fields(costmap_->params());
  const auto is_fixed = [](const ConfigField& field) {
    return std::find(std::begin(kFixedParams), std::end(kFixedParams), field.name) !=
           std::end(kFixedParams);
  };
  fields.erase(std::remove_if(fields.begin(), fields.end(), is_fixed), fields.end());
  return fields;
}

void CostmapNode::change(const ConfigNode& values) {
  const std::lock_guard lock(mutex_);
  CostmapParams params = costmap_->params();
  config_detail::ConfigReader::read_struct(values, "parameter", node_.getNamespace(), params);
  costmap_->set_params(params);
  note_params(params);
}

void CostmapNode::change_layer(const std::string& name, const ConfigNode& values) {
  const std::lock_guard lock(mutex_);
  const auto spec = std::find_if(layers_.begin(), layers_.end(),
                                 [&](const LayerSpec& one) { return one.setup.name == name; });
  LayerSetup setup = spec->setup;
  setup.config = values;
  builtin_layer_types().get(plugin_class(spec->plugin)).change(*costmap_->layer(name), setup);
}

std::optional<Pose2> CostmapNode::robot(double now_s, std::string* problem, double* stamp_s) const {
  if (robot_source_) {
    if (stamp_s != nullptr) *stamp_s = now_s;
    return robot_source_(now_s, problem);
  }
  return newest_pose(buffer_, frame_, base_frame_, now_s, transform_tolerance_s_, problem, stamp_s);
}

void CostmapNode::update(double now_s) {
  std::string problem;
  const std::optional<Pose2> pose = robot(now_s, &problem);
  if (!pose) return;
  const std::lock_guard lock(mutex_);
  inputs_.apply(now_s);
  costmap_->update({now_s, *pose});
  topics_.voxels->publish(now_s);
  news_.is_all |= costmap_->has_moved();
  if (!news_.is_all) news_.box = joined(news_.box, costmap_->changed().bounds());
  const double rate = costmap_->params().publish_frequency;
  const bool is_time_back = now_s < news_.published_s;
  if (rate > 0.0 && (is_time_back || (now_s - news_.published_s) * rate >= 1.0 - 1e-6)) {
    publish(now_s, *pose);
  }
}

std::string CostmapNode::missing() {
  const std::lock_guard lock(mutex_);
  for (const auto& layer : costmap_->layers()) {
    const auto* map = dynamic_cast<const StaticLayer*>(layer.get());
    if (map != nullptr && map->is_enabled() && !map->has_map()) {
      return "no map has come on topic " + map->params().map_topic + " for layer " + map->name();
    }
  }
  return "";
}

void CostmapNode::publish(double now_s, const Pose2& robot) {
  news_.published_s = now_s;
  publish_footprint(now_s, robot);
  if (news_.is_all || costmap_->params().always_send_full_costmap) {
    publish_all(now_s);
  } else if (!news_.box.empty()) {
    publish_part(now_s, news_.box);
  }
  news_.is_all = false;
  news_.box = {};
}

void CostmapNode::publish_all(double now_s) {
  const CostGrid grid = costmap_->grid();
  nav_msgs::OccupancyGrid message;
  message.header.stamp.fromSec(now_s);
  message.header.frame_id = frame_;
  message.info.resolution = static_cast<float>(grid.geometry.resolution);
  message.info.width = static_cast<std::uint32_t>(grid.geometry.width);
  message.info.height = static_cast<std::uint32_t>(grid.geometry.height);
  message.info.origin = to_message({grid.geometry.origin_x, grid.geometry.origin_y, 0.0});
  message.data.resize(grid.geometry.size());
  std::transform(grid.cost, grid.cost + grid.geometry.size(), message.data.begin(), published_cost);
  topics_.all.publish(message);
}

void CostmapNode::publish_part(double now_s, const CellBox& box) {
  const CostGrid grid = costmap_->grid();
  map_msgs::OccupancyGridUpdate message;
  message.header.stamp.fromSec(now_s);
  message.header.frame_id = frame_;
  message.x = box.x0;
  message.y = box.y0;
  message.width = static_cast<std::uint32_t>(box.x1 - box.x0);
  message.height = static_cast<std::uint32_t>(box.y1 - box.y0);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      message.data.push_back(published_cost(grid.at(Cell{x, y})));
    }
  }
  topics_.parts.publish(message);
}

void CostmapNode::publish_footprint(double now_s, const Pose2& robot) {
  geometry_msgs::PolygonStamped message;
  message.header.stamp.fromSec(now_s);
  message.header.frame_id = frame_;
  for (const Point2& p : footprint_corners(costmap_->footprint(), robot)) {
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(p.x);
    point.y = static_cast<float>(p.y);
    message.polygon.points.push_back(point);
  }
  topics_.footprint.publish(message);
}

}  // namespace trident::nav
