// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/costmap_inputs.h"

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <utility>

#include "trident_base/error.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_nav_ros/frames.h"
#include "trident_nav_ros/input_checks.h"
#include "trident_ros/message_checks.h"

namespace trident::nav {
namespace {

constexpr double kMaxWait_s = 1.0;  // for a transform
constexpr int kBeamQueue = 10;
constexpr std::size_t kMaxPending = 50;
constexpr std::size_t kKeptStamps = 20;  // of scans, in lockstep
// Between data and the update that takes them: more than their stamps differ from their period by,
// and less than a simulator continues by before it waits.
constexpr double kLockstepMargin_s = 0.005;

LaserScan to_scan(const sensor_msgs::LaserScan& message) {
  LaserScan scan;
  scan.stamp_ns = static_cast<std::int64_t>(message.header.stamp.toNSec());
  scan.angle_min = static_cast<double>(message.angle_min);
  scan.angle_increment = static_cast<double>(message.angle_increment);
  scan.time_increment = static_cast<double>(message.time_increment);
  scan.range_min = static_cast<double>(message.range_min);
  scan.range_max = static_cast<double>(message.range_max);
  scan.ranges = message.ranges;
  return scan;
}

std::vector<Eigen::Vector3f> points_of(const sensor_msgs::PointCloud2& cloud) {
  const std::string problem = cloud_problem(cloud);
  if (!problem.empty()) throw Error(problem);
  std::vector<Eigen::Vector3f> points;
  points.reserve(static_cast<std::size_t>(cloud.width) * cloud.height);
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  for (; x != x.end(); ++x, ++y, ++z) points.emplace_back(*x, *y, *z);
  return points;
}

std::vector<Eigen::Vector3f> points_of(const sensor_msgs::PointCloud& cloud) {
  std::vector<Eigen::Vector3f> points;
  for (const geometry_msgs::Point32& p : cloud.points) points.emplace_back(p.x, p.y, p.z);
  return points;
}

std::string unused(const BeamSource& source) {
  return "data of " + source.name() + " (topic " + source.topic() + ") are not used: ";
}

}  // namespace

CostmapInputs::CostmapInputs(ros::NodeHandle& node, Costmap& costmap, const tf2::BufferCore& buffer,
                             ros_utils::Refusals& refusals)
    : costmap_(costmap),
      buffer_(buffer),
      refusals_(refusals),
      frame_(frame_name(costmap.params().global_frame)) {
  for (const auto& layer : costmap.layers()) {
    if (auto* map = dynamic_cast<StaticLayer*>(layer.get())) subscribe_map(node, *map);
    if (auto* beams = dynamic_cast<BeamLayer*>(layer.get())) subscribe_beams(node, *beams);
  }
}

void CostmapInputs::subscribe_map(ros::NodeHandle& node, StaticLayer& layer) {
  const auto later = [this](std::function<void()> work) {
    const std::lock_guard lock(mutex_);
    maps_.push_back(std::move(work));
  };
  const std::string topic = layer.params().map_topic;
  subscribers_.push_back(node.subscribe<nav_msgs::OccupancyGrid>(
      topic, 1, [&layer, later](const nav_msgs::OccupancyGridConstPtr& message) {
        later([&layer, message] { layer.set_map(maps::from_map_message(*message)); });
      }));
  if (!layer.params().subscribe_to_updates) return;
  subscribers_.push_back(node.subscribe<map_msgs::OccupancyGridUpdate>(
      topic + "_updates", 10, [&layer, later](const map_msgs::OccupancyGridUpdateConstPtr& part) {
        later([&layer, part] {
          const CellBox box{part->x, part->y, part->x + static_cast<int>(part->width),
                            part->y + static_cast<int>(part->height)};
          layer.update_map(box, part->data);
        });
      }));
}

void CostmapInputs::subscribe_beams(ros::NodeHandle& node, BeamLayer& layer) {
  for (BeamSource& source : layer.sources()) {
    switch (source.params().data_type) {
      case BeamDataType::kLaserScan:
        subscribe_scans(node, source);
        break;
      case BeamDataType::kPointCloud2:
        subscribe_clouds<sensor_msgs::PointCloud2>(node, source);
        break;
      case BeamDataType::kPointCloud:
        subscribe_clouds<sensor_msgs::PointCloud>(node, source);
        break;
    }
  }
}

void CostmapInputs::subscribe_scans(ros::NodeHandle& node, BeamSource& source) {
  subscribers_.push_back(node.subscribe<sensor_msgs::LaserScan>(
      source.topic(), kBeamQueue, [this, &source](const sensor_msgs::LaserScanConstPtr& scan) {
        if (is_refused(source, scan->header.stamp)) return;
        add(source, scan->header.stamp, [this, &source, scan] { return observe(*scan, source); });
      }));
}

template <class Cloud>
void CostmapInputs::subscribe_clouds(ros::NodeHandle& node, BeamSource& source) {
  subscribers_.push_back(node.subscribe<Cloud>(
      source.topic(), kBeamQueue, [this, &source](const typename Cloud::ConstPtr& cloud) {
        if (is_refused(source, cloud->header.stamp)) return;
        add(source, cloud->header.stamp, [this, &source, cloud]() -> std::optional<Observation> {
          const ros::Time& stamp = cloud->header.stamp;
          const SE3 pose = sensor_pose(cloud->header.frame_id, source.params(), stamp);
          return observe_points(stamp.toSec(), points_of(*cloud), pose);
        });
      }));
}

/// Notes data whose stamp nothing can be computed with.
bool CostmapInputs::is_refused(const BeamSource& source, const ros::Time& stamp) {
  const std::string problem = ros_utils::stamp_problem(stamp, ros::Time::now());
  if (problem.empty()) return false;
  refusals_.note("data", unused(source) + problem);
  return true;
}

void CostmapInputs::add(BeamSource& source, const ros::Time& stamp, Observe observe) {
  const std::lock_guard lock(mutex_);
  if (pending_.size() >= kMaxPending) pending_.pop_front();
  pending_.push_back({&source, std::move(observe), stamp.toSec(), ros::WallTime::now()});
  received_[&source].note(stamp.toSec());
  if (is_lockstep_) note_scan(source, stamp.toSec());
}

/// While locked.
void CostmapInputs::note_scan(const BeamSource& source, double stamp_s) {
  if (source.params().data_type != BeamDataType::kLaserScan) return;
  if (scan_times_.source == nullptr) scan_times_.source = &source;
  if (scan_times_.source != &source) return;
  std::deque<double>& stamps_s = scan_times_.stamps_s;
  if (!stamps_s.empty() && stamp_s < stamps_s.back()) stamps_s.clear();  // time goes back
  stamps_s.push_back(stamp_s);
  if (stamps_s.size() > kKeptStamps) stamps_s.pop_front();
}

std::optional<double> CostmapInputs::await_scan(double now_s) {
  await_data(now_s);
  const std::lock_guard lock(mutex_);
  const std::deque<double>& stamps_s = scan_times_.stamps_s;
  const auto newest = std::find_if(stamps_s.rbegin(), stamps_s.rend(), [now_s](double stamp_s) {
    return stamp_s < now_s - kLockstepMargin_s;
  });
  if (newest == stamps_s.rend()) return std::nullopt;
  return *newest;
}

/// Whether data of a source are to come that an update takes. A period is known from the second
/// data on.
bool CostmapInputs::is_late(double now_s) {
  const std::lock_guard lock(mutex_);
  return std::any_of(received_.begin(), received_.end(), [now_s](const auto& entry) {
    const SourceAge& age = entry.second;
    const double next_s = age.newest_s() + age.period_s();
    return age.period_s() > 0.0 && next_s < now_s - kLockstepMargin_s;
  });
}

/// For a while: a source may have ended.
void CostmapInputs::await_data(double now_s) {
  const ros::WallTime begun = ros::WallTime::now();
  while (ros::ok() && (ros::WallTime::now() - begun).toSec() < kMaxWait_s && is_late(now_s)) {
    ros::WallDuration(1e-4).sleep();
  }
}

bool CostmapInputs::has_news() {
  const std::lock_guard lock(mutex_);
  return !pending_.empty() || !maps_.empty();
}

SE3 CostmapInputs::sensor_pose(const std::string& frame, const BeamSourceParams& params,
                               const ros::Time& stamp) const {
  const std::string& sensor = params.sensor_frame.empty() ? frame : params.sensor_frame;
  return to_se3(buffer_.lookupTransform(frame_, frame_name(sensor), stamp).transform);
}

/// The beams of a scan that takes long get the poses at its begin and end.
std::optional<Observation> CostmapInputs::observe(const sensor_msgs::LaserScan& message,
                                                  const BeamSource& source) {
  const BeamSourceParams& params = source.params();
  const std::string problem = beams_problem(message);
  if (!problem.empty()) throw Error(problem);
  const LaserScan scan = to_scan(message);
  const ros::Time begin = message.header.stamp;
  std::vector<SE3> poses{sensor_pose(message.header.frame_id, params, begin)};
  const double duration_s = scan.time_increment * static_cast<double>(scan.size() - 1);
  if (duration_s > 0.0) {
    poses.push_back(
        sensor_pose(message.header.frame_id, params, begin + ros::Duration(duration_s)));
  }
  if (on_scan_ && params.marking) on_scan_(source, scan, poses);
  return observe_scan(scan, poses, params.inf_is_valid);
}

void CostmapInputs::hand_over(const Pending& pending) {
  auto observation = pending.observe();
  if (!observation) return;
  if (on_observation_) on_observation_(*pending.source, *observation);
  pending.source->add(std::move(*observation));
}

/// Whether data are of before the first transforms: nothing is wrong, and newer ones have come or
/// will.
bool CostmapInputs::is_early(const Pending& pending, const tf2::TransformException& error) {
  const SourceAge& age = pending.source->age();
  const bool is_superseded = !age.has_data() || pending.stamp_s < age.newest_s();
  return dynamic_cast<const tf2::ExtrapolationException*>(&error) != nullptr && is_superseded;
}

void CostmapInputs::apply_pending(Pending& pending, std::deque<Pending>* waiting) {
  const BeamSource& source = *pending.source;
  try {
    hand_over(pending);
  } catch (const tf2::TransformException& error) {
    if ((ros::WallTime::now() - pending.since).toSec() < kMaxWait_s) {
      waiting->push_back(std::move(pending));
    } else if (!is_early(pending, error)) {
      refusals_.note("transform", unused(source) + error.what());
    }
  } catch (const std::exception& error) {
    refusals_.note("data", unused(source) + error.what());
  }
}

void CostmapInputs::apply_maps(const std::vector<std::function<void()>>& maps) {
  for (const auto& set_map : maps) {
    try {
      set_map();
    } catch (const Error& error) {
      refusals_.note("map", std::string("a map is not used: ") + error.what());
    }
  }
}

void CostmapInputs::apply(double now_s) {
  if (is_lockstep_) await_data(now_s);
  std::deque<Pending> pending, waiting;
  std::vector<std::function<void()>> maps;
  {
    const std::lock_guard lock(mutex_);
    pending.swap(pending_);
    maps.swap(maps_);
  }
  apply_maps(maps);
  for (Pending& one : pending) {
    if (is_lockstep_ && one.stamp_s >= now_s - kLockstepMargin_s) {
      waiting.push_back(std::move(one));  // the next update takes it in any case
    } else {
      apply_pending(one, &waiting);
    }
  }
  const std::lock_guard lock(mutex_);
  pending_.insert(pending_.begin(), std::make_move_iterator(waiting.begin()),
                  std::make_move_iterator(waiting.end()));
}

}  // namespace trident::nav
