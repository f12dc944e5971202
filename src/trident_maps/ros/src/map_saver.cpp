// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <nav_msgs/OccupancyGrid.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "trident_maps/map_file.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_maps_ros/map_server_node.h"
#include "trident_ros/refusals.h"

namespace trident::maps {
namespace {

constexpr const char* kUsage =
    "usage: map_saver [--occ 1..100] [--free 0..100] [-f NAME] [map:=TOPIC]";

struct SaverOptions {
  std::string name = "map";
  SaveThresholds thresholds;
};

int percent(const std::string& option, const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || errno != 0 || value < -1000 || value > 1000) {
    throw Error(option + ": '" + text + "', legal: a whole number of percent");
  }
  return static_cast<int>(value);
}

/// The arguments of upstream's map_saver: -f NAME, --occ PERCENT and --free PERCENT. A later one of
/// the same name counts.
SaverOptions parse_options(int argc, char** argv) {
  SaverOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word != "-f" && word != "--occ" && word != "--free") {
      throw Error("unknown word '" + word + "'; " + kUsage);
    }
    if (++i == argc) throw Error(word + " needs a value; " + kUsage);
    if (word == "-f") {
      options.name = argv[i];
    } else {
      int& value = word == "--occ" ? options.thresholds.occupied : options.thresholds.free;
      value = percent(word, argv[i]);
    }
  }
  options.thresholds.validate();
  return options;
}

bool save_or_log(const SaverOptions& options, const OccupancyGrid& grid) {
  try {
    save_map(options.name, grid, options.thresholds);
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return false;
  }
  ROS_INFO("%s.pgm and .yaml: %d x %d cells of %.3f m", options.name.c_str(), grid.width,
           grid.height, grid.resolution);
  return true;
}

/// The message's grid; a message without one is reported, and the next one waited for.
std::optional<OccupancyGrid> grid_of(const nav_msgs::OccupancyGrid& message,
                                     ros_utils::Refusals& refusals) {
  try {
    return from_map_message(message);
  } catch (const Error& error) {
    refusals.note("map refused", std::string("map refused, still waiting: ") + error.what());
    return std::nullopt;
  }
}

/// Waits for the first map that is one, and saves it. Returns the process' exit code.
int save_first_map(const SaverOptions& options) {
  ros::NodeHandle node;
  ros_utils::Refusals refusals(node);
  std::optional<int> result;  // of the map that has come
  const boost::function<void(const nav_msgs::OccupancyGridConstPtr&)> save =
      [&](const nav_msgs::OccupancyGridConstPtr& message) {
        // Several messages may have come in one call of the queue; the first map is saved.
        if (result) return;
        const std::optional<OccupancyGrid> grid = grid_of(*message, refusals);
        if (grid) result = save_or_log(options, *grid) ? 0 : 1;
      };
  const ros::Subscriber subscriber = node.subscribe<nav_msgs::OccupancyGrid>("map", 1, save);
  ROS_INFO("waiting for a map on %s", subscriber.getTopic().c_str());
  while (ros::ok() && !result) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  return result.value_or(1);
}

}  // namespace

int map_saver_main(int argc, char** argv) {
  ros::init(argc, argv, "map_saver", ros::init_options::AnonymousName);
  try {
    return save_first_map(parse_options(argc, argv));
  } catch (const Error& error) {
    std::fprintf(stderr, "map_saver: %s\n", error.what());  // NOLINT: before there is a log
    return 2;
  }
}

}  // namespace trident::maps
