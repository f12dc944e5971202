// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/guarded_slam.h"

#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "trident_base/error.h"
#include "trident_maps/map_file.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

GuardedSlam::GuardedSlam(MakeSlam make, bool uses_odometry)
    : make_(std::move(make)), uses_odometry_(uses_odometry), slam_(make_slam()) {}

std::unique_ptr<Slam2d> GuardedSlam::make_slam() const {
  std::unique_ptr<Slam2d> slam = make_();
  if (uses_odometry_) return slam;
  auto* able = dynamic_cast<Slam2dOdometryUse*>(slam.get());
  if (able == nullptr) throw Error("parameter odom_frame is empty, but this method needs odometry");
  able->set_uses_odometry(false);
  return slam;
}

void GuardedSlam::reset() {
  std::unique_ptr<Slam2d> next = make_slam();
  const std::lock_guard<std::mutex> lock(mutex_);
  slam_.swap(next);
}

std::function<OccupancyGrid()> GuardedSlam::map_snapshot() {
  return with([](const Slam2d& slam) -> std::function<OccupancyGrid()> {
    const auto* able = dynamic_cast<const Slam2dMapSnapshot*>(&slam);
    if (able != nullptr) return able->map_snapshot();
    return [map = slam.map()] { return map; };
  });
}

std::function<void(const std::string&)> GuardedSlam::session_snapshot() {
  return with([](const Slam2d& slam) {
    const auto* session = dynamic_cast<const Slam2dSession*>(&slam);
    if (session == nullptr) throw Error("this method cannot keep sessions");
    return session->session_snapshot();
  });
}

void GuardedSlam::rescue(const std::string& stem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  save_all(stem);
}

void GuardedSlam::rescue_after_crash(const std::string& stem) {
  // A lock that the thread that failed holds is never released.
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  save_all(stem);
}

void GuardedSlam::save_all(const std::string& stem) const {
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(stem).parent_path(), ignored);
  const auto* session = dynamic_cast<const Slam2dSession*>(slam_.get());
  try {
    if (session != nullptr) session->session_snapshot()(stem + ".posegraph");
    trident::maps::save_map(stem, slam_->map());
  } catch (const Error& error) {
    std::fprintf(stderr, "the map cannot be saved: %s\n", error.what());  // NOLINT: log may be gone
  }
}

}  // namespace trident::slam
