// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/route_exchange.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "trident_base/angle.h"
#include "trident_ros/message_checks.h"

namespace trident::bridges {
namespace {

constexpr std::uint32_t kRouteQueueSize = 10;
constexpr std::size_t kMaxPlaces = 999;  ///< of a route: the names have three digits

constexpr std::array<const char*, 8> kGuidanceSentences{"APB", "APA", "RMB", "XTE",
                                                        "BOD", "BWC", "WPL", "RTE"};

bool sends_guidance(const nmea::TalkerParams& params) {
  return std::any_of(kGuidanceSentences.begin(), kGuidanceSentences.end(), [&](const char* name) {
    const auto rate = params.rates.find(name);
    return rate != params.rates.end() && rate->second > 0.0;
  });
}

std::string waypoint_name(std::size_t index) {
  std::array<char, 24> name{};
  std::snprintf(name.data(), name.size(), "WP%03zu", index + 1);
  return name.data();
}

}  // namespace

RouteExchange::RouteExchange(ros::NodeHandle& node, NodePollLoop& loop,
                             const NmeaNodeParams& params, nmea::SentenceSender& sender,
                             const UtcClock& clock, ros_utils::Refusals& refusals)
    : steers_(params.autopilot.is_on),
      frame_(params.origin),
      refusals_(refusals),
      guidance_(sender, clock, params.guidance) {
  if (steers_) {
    heading_ = node.advertise<std_msgs::Float64>("command/heading", kRouteQueueSize);
    path_ = node.advertise<nav_msgs::Path>("command/path", kRouteQueueSize);
  }
  if (!sends_guidance(params.talker) || params.topics.path.empty()) return;
  subscription_ =
      loop.subscribe<nav_msgs::Path>(node, params.topics.path, kRouteQueueSize,
                                     [this](const nav_msgs::Path& path) { on_path(path); });
}

AutopilotHooks RouteExchange::autopilot() {
  if (!steers_) return {};
  return {[this](const nmea::SteeringEvent& steering) { steer(steering); },
          [this](const std::vector<nmea::RoutePlace>& places) { follow(places); }};
}

void RouteExchange::steer(const nmea::SteeringEvent& steering) {
  if (!steering.heading_rad) return;
  std_msgs::Float64 message;
  message.data = wrap_to_pi(0.5 * kPi - *steering.heading_rad - frame_.heading_rad());
  heading_.publish(message);
}

void RouteExchange::follow(const std::vector<nmea::RoutePlace>& places) {
  if (!frame_.is_known()) {
    refusals_.note(
        "route refused",
        "route refused: the vehicle's place is not known: neither origin/given nor a fix "
        "with odometry");
    return;
  }
  nav_msgs::Path path;
  path.header.frame_id = frame_id_;
  for (const nmea::RoutePlace& place : places) {
    const Eigen::Vector2d p_frame = frame_.to_frame(place);
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = frame_id_;
    pose.pose.position.x = p_frame.x();
    pose.pose.position.y = p_frame.y();
    pose.pose.orientation.w = 1.0;
    path.poses.push_back(pose);
  }
  path_.publish(path);
}

void RouteExchange::on_fix(const nmea::RoutePlace& place, double altitude_m) {
  if (!p_frame_vehicle_ || frame_.is_known()) return;
  frame_.set_place(place, altitude_m, *p_frame_vehicle_);
  make_route();
}

void RouteExchange::on_position(SimTime stamp, const std::string& frame_id,
                                const Eigen::Vector2d& p_frame,
                                const nmea::GroundVelocity& velocity) {
  frame_id_ = frame_id;
  p_frame_vehicle_ = p_frame;
  const Eigen::Vector2d p_enu = frame_.R_enu_frame() * p_frame;
  guidance_.on_position(stamp, p_enu.x(), p_enu.y(), velocity);
}

void RouteExchange::on_path(const nav_msgs::Path& path) {
  p_frame_route_.clear();
  for (const geometry_msgs::PoseStamped& pose : path.poses) {
    const auto& p = pose.pose.position;
    const std::string problem = ros_utils::point_problem(p.x, p.y, p.z, "position");
    if (!problem.empty() || p_frame_route_.size() == kMaxPlaces) {
      refusals_.note("path refused",
                     "path refused: " + (problem.empty() ? "has more than 999 places" : problem));
      p_frame_route_.clear();
      break;
    }
    p_frame_route_.emplace_back(p.x, p.y);
  }
  make_route();
}

/// Gives the places names and coordinates, once the frame is known.
void RouteExchange::make_route() {
  if (!frame_.is_known()) return;
  std::vector<nmea::Waypoint> route;
  for (std::size_t i = 0; i < p_frame_route_.size(); ++i) {
    const Eigen::Vector2d& p = p_frame_route_[i];
    const nmea::RoutePlace place = frame_.to_earth(p);
    const Eigen::Vector2d p_enu = frame_.R_enu_frame() * p;
    route.push_back(
        {waypoint_name(i), place.latitude_deg, place.longitude_deg, p_enu.x(), p_enu.y()});
  }
  guidance_.set_route(std::move(route));
}

}  // namespace trident::bridges
