// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>

#include <optional>
#include <string>

namespace trident::slam {

/// The smallest rectangle of cells in which two maps of the same size and place differ, with what
/// the newer one has there; zero cells when they are equal, nothing when size or place differ.
std::optional<map_msgs::OccupancyGridUpdate> changed_part(const nav_msgs::OccupancyGrid& whole,
                                                          const nav_msgs::OccupancyGrid& newer);

/// A map on `topic` and `topic`_metadata, latched and whole, and what has changed since on
/// `topic`_updates: who has the newest whole map and the newest update has the newest map.
class MapPublisher {
 public:
  /// How often something is published while somebody listens.
  struct Periods {
    double whole = 5.0;    ///< between two whole maps [s]
    double changes = 1.0;  ///< between what is published at all [s]; 0: whole maps alone
  };

  /// Advertises the three topics below `handle`'s namespace.
  MapPublisher(ros::NodeHandle& handle, const std::string& topic, const Periods& periods);

  /// Whether something should be published at `now` (any clock) for those who listen.
  bool is_due(const ros::Time& now) const;
  /// Publishes the whole map or, between whole ones, what has changed.
  void publish(const nav_msgs::OccupancyGrid& map, const ros::Time& now);

 private:
  bool is_whole_due(const ros::Time& now) const;

  Periods periods_;
  ros::Publisher whole_, metadata_, changes_;
  nav_msgs::OccupancyGrid last_whole_;
  ros::Time last_whole_time_, last_time_;
};

}  // namespace trident::slam
