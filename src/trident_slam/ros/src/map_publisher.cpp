// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/map_publisher.h"

#include <nav_msgs/MapMetaData.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trident::slam {
namespace {

bool is_same_place(const nav_msgs::MapMetaData& a, const nav_msgs::MapMetaData& b) {
  return a.width == b.width && a.height == b.height && a.resolution == b.resolution &&
         a.origin.position.x == b.origin.position.x && a.origin.position.y == b.origin.position.y &&
         a.origin.orientation.z == b.origin.orientation.z &&
         a.origin.orientation.w == b.origin.orientation.w;
}

// Clocks that go backwards count, too: a bag that is played again.
bool has_passed(const ros::Time& since, const ros::Time& now, double period) {
  return since.isZero() || std::abs((now - since).toSec()) >= period;
}

}  // namespace

std::optional<map_msgs::OccupancyGridUpdate> changed_part(const nav_msgs::OccupancyGrid& whole,
                                                          const nav_msgs::OccupancyGrid& newer) {
  if (!is_same_place(whole.info, newer.info)) return std::nullopt;
  const auto width = static_cast<std::int64_t>(newer.info.width);
  std::int64_t left = width, right = -1, bottom = newer.info.height, top = -1;
  for (std::size_t i = 0; i < newer.data.size(); ++i) {
    if (whole.data[i] == newer.data[i]) continue;
    const auto column = static_cast<std::int64_t>(i) % width;
    const auto row = static_cast<std::int64_t>(i) / width;
    left = std::min(left, column);
    right = std::max(right, column);
    bottom = std::min(bottom, row);
    top = std::max(top, row);
  }
  map_msgs::OccupancyGridUpdate update;
  update.header = newer.header;
  if (top < 0) return update;
  update.x = static_cast<std::int32_t>(left);
  update.y = static_cast<std::int32_t>(bottom);
  update.width = static_cast<std::uint32_t>(right - left + 1);
  update.height = static_cast<std::uint32_t>(top - bottom + 1);
  update.data.reserve(static_cast<std::size_t>(update.width) * update.height);
  for (std::int64_t row = bottom; row <= top; ++row) {
    const auto begin = newer.data.begin() + row * width;
    update.data.insert(update.data.end(), begin + left, begin + right + 1);
  }
  return update;
}

MapPublisher::MapPublisher(ros::NodeHandle& handle, const std::string& topic,
                           const Periods& periods)
    : periods_(periods),
      whole_(handle.advertise<nav_msgs::OccupancyGrid>(topic, 1, true)),
      metadata_(handle.advertise<nav_msgs::MapMetaData>(topic + "_metadata", 1, true)),
      changes_(handle.advertise<map_msgs::OccupancyGridUpdate>(topic + "_updates", 10)) {}

bool MapPublisher::is_whole_due(const ros::Time& now) const {
  return has_passed(last_whole_time_, now, periods_.whole);
}

bool MapPublisher::is_due(const ros::Time& now) const {
  const bool is_heard = whole_.getNumSubscribers() > 0 || metadata_.getNumSubscribers() > 0;
  if (is_heard && is_whole_due(now)) return true;
  return periods_.changes > 0.0 && changes_.getNumSubscribers() > 0 &&
         has_passed(last_time_, now, periods_.changes);
}

void MapPublisher::publish(const nav_msgs::OccupancyGrid& map, const ros::Time& now) {
  last_time_ = now;
  const auto update = is_whole_due(now) ? std::nullopt : changed_part(last_whole_, map);
  if (update) {
    if (!update->data.empty()) changes_.publish(*update);
    return;
  }
  last_whole_ = map;
  last_whole_time_ = now;
  whole_.publish(map);
  metadata_.publish(map.info);
}

}  // namespace trident::slam
