// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/scan_input.h"

#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_ros/message_checks.h"

namespace trident::estimation {
namespace {

constexpr std::size_t kMaxWaiting = 100;
constexpr double kLookEvery = 0.005;    // while something waits [s]
constexpr double kLateAfter = 0.5;      // wall time [s]
constexpr double kForEndOfScan = 0.2;   // wall time waited for the transform of the last beam [s]
constexpr double kGivenUpAfter = 10.0;  // time of ROS [s]

std::string fixed(double value) {
  char text[64];  // NOLINT: of snprintf
  std::snprintf(text, sizeof(text), "%.3f", value);
  return text;
}

SE2 planar(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.orientation = transform.rotation;
  return maps::from_pose_message(pose);
}

/// Upside down a scan runs clockwise.
bool is_upside_down(const geometry_msgs::Quaternion& q) {
  return 1.0 - 2.0 * (q.x * q.x + q.y * q.y) < 0.0;
}

void fill_scan(const sensor_msgs::LaserScan& message, bool is_upside_down, LaserScan& scan) {
  const double turn = is_upside_down ? -1.0 : 1.0;
  scan.stamp_ns = static_cast<std::int64_t>(message.header.stamp.toNSec());
  scan.angle_min = turn * static_cast<double>(message.angle_min);
  scan.angle_increment = turn * static_cast<double>(message.angle_increment);
  scan.time_increment =
      std::isnan(message.time_increment) ? 0.0 : static_cast<double>(message.time_increment);
  scan.range_min = static_cast<double>(message.range_min);
  scan.range_max = static_cast<double>(message.range_max);
  scan.ranges = message.ranges;
}

}  // namespace

ScanPatience scan_patience(double wall_s, double ros_s) {
  if (wall_s < kLateAfter) return ScanPatience::kWaits;
  return ros_s > kGivenUpAfter ? ScanPatience::kIsOver : ScanPatience::kIsNamed;
}

ScanInput::ScanInput(ros::NodeHandle& node, const ScanInputParams& params,
                     ros_utils::DiagnosticCounter& problems, Handler on_scan,
                     std::function<void()> on_new_time)
    : params_(params),
      problems_(problems),
      on_scan_(std::move(on_scan)),
      on_new_time_(std::move(on_new_time)),
      buffer_(ros::Duration(30.0)),
      transforms_(
          buffer_,
          [this](const std::string& problem) { problems_.note("transform refused", problem); }),
      subscriber_(node.subscribe("scan", kMaxWaiting, &ScanInput::receive, this)),
      timer_(node.createWallTimer(ros::WallDuration(kLookEvery),
                                  [this](const ros::WallTimerEvent&) { hand_out(); })) {}

SE2 ScanInput::looked_up(const std::string& target, const std::string& source,
                         const ros::Time& stamp) const {
  return planar(buffer_.lookupTransform(target, source, stamp).transform);
}

SE2 ScanInput::T_odom_base(const ros::Time& stamp) const {
  return looked_up(params_.odom_frame_id, params_.base_frame_id, stamp);
}

const ScanInput::Laser& ScanInput::laser(const std::string& frame) {
  const auto known = lasers_.find(frame);
  if (known != lasers_.end()) return known->second;
  const auto found = buffer_.lookupTransform(params_.base_frame_id, frame, ros::Time(0)).transform;
  return lasers_[frame] = {planar(found), is_upside_down(found.rotation)};
}

/// Counts a message that no transform could make useful.
bool ScanInput::is_refused(const sensor_msgs::LaserScan& message) {
  std::string problem = ros_utils::stamp_problem(message.header.stamp, ros::Time::now());
  if (problem.empty()) problem = ros_utils::scan_problem(message);
  if (problem.empty() && !std::isfinite(message.range_max)) problem = "range_max is not finite";
  if (problem.empty()) return false;
  problems_.note("scan refused", "scan of '" + ros_utils::quoted(message.header.frame_id) +
                                     "' at " + fixed(message.header.stamp.toSec()) +
                                     " s: " + problem);
  return true;
}

void ScanInput::receive(const sensor_msgs::LaserScanConstPtr& message) {
  ++received_;
  if (is_refused(*message)) return;
  const ros::Time stamp = message->header.stamp;
  const double back = (last_stamp_ - stamp).toSec();
  if (back > params_.bag_loop_jump) {
    problems_.note("time went back", "stamps of scans went back by " + fixed(back) +
                                         " s: taken for a bag that starts again");
    waiting_.clear();
    transforms_.clear();
    on_new_time_();
    last_stamp_ = stamp;
  }
  last_stamp_ = std::max(last_stamp_, stamp);
  if (waiting_.size() == kMaxWaiting) {
    note_missing(waiting_.front(), "");
    waiting_.pop_front();
  }
  waiting_.push_back({message, ros::WallTime::now(), ros::Time::now(), false});
  hand_out();
}

void ScanInput::hand_out() {
  while (!waiting_.empty() && try_first()) waiting_.pop_front();
}

/// False: the transform at the scan's end may still come. Throws tf2's exceptions and Error.
bool ScanInput::place(const sensor_msgs::LaserScan& message, double waited, PlacedScan& placed) {
  placed.stamp = message.header.stamp;
  const Laser& mounted = laser(message.header.frame_id);
  fill_scan(message, mounted.is_upside_down, placed.scan);
  placed.scan.T_base_laser = mounted.T_base_laser;
  placed.T_odom_base = T_odom_base(placed.stamp);
  const double lasts =
      static_cast<double>(message.time_increment) * static_cast<double>(message.ranges.size());
  if (!(lasts > 0.0)) return true;
  const ros::Time end = placed.stamp + ros::Duration(lasts);
  const bool is_known = buffer_.canTransform(params_.odom_frame_id, params_.base_frame_id, end);
  if (!is_known && waited < kForEndOfScan) return false;
  if (is_known) placed.T_start_end = placed.T_odom_base.inverse() * T_odom_base(end);
  return true;
}

/// True: the first one is done with.
bool ScanInput::try_first() {
  Waiting& waiting = waiting_.front();
  const double waited = (ros::WallTime::now() - waiting.since).toSec();
  PlacedScan placed;
  try {
    if (!place(*waiting.message, waited, placed)) return false;
  } catch (const tf2::TransformException& error) {
    const double waited_ros = (ros::Time::now() - waiting.since_ros).toSec();
    const ScanPatience patience = scan_patience(waited, waited_ros);
    if (patience == ScanPatience::kWaits) return false;
    return !note_missing(waiting, error.what()) || patience == ScanPatience::kIsOver;
  } catch (const Error& error) {
    problems_.note("transform refused", error.what());
    return true;
  }
  on_scan_(placed);
  return true;
}

/// What is to be said of a transform that the scan waits for; nothing: it has come, or is static.
std::optional<ScanInput::Problem> ScanInput::missing_transform(const std::string& target,
                                                               const std::string& source,
                                                               const std_msgs::Header& scan) const {
  const std::string name = target + " -> " + source;
  try {
    const ros::Time newest = buffer_.lookupTransform(target, source, ros::Time(0)).header.stamp;
    if (newest.isZero() || newest >= scan.stamp)
      return std::nullopt;  // static, or not the late one
    return Problem{"transform late", "transform " + name + " is " +
                                         fixed((scan.stamp - newest).toSec()) +
                                         " s late for the scan of " + scan.frame_id + " at " +
                                         fixed(scan.stamp.toSec()) + " s; the scan waits"};
  } catch (const tf2::TransformException& error) {
    return Problem{"transform missing", "no transform " + name + " for the scan of " +
                                            scan.frame_id + ": " + error.what()};
  }
}

// Once for each scan. False: what is missing can no longer come.
bool ScanInput::note_missing(Waiting& waiting, const std::string& reason) {
  const bool is_reported = std::exchange(waiting.is_reported, true);
  const std_msgs::Header& scan = waiting.message->header;
  const auto report = [&](const Problem& problem) {
    if (!is_reported) problems_.note(problem.key, problem.text);
  };
  for (const auto& [target, source] : {std::pair{params_.base_frame_id, scan.frame_id},
                                       {params_.odom_frame_id, params_.base_frame_id}}) {
    const std::optional<Problem> problem = missing_transform(target, source, scan);
    if (!problem) continue;
    report(*problem);
    return true;
  }
  // Transforms come in a thread of their own: it may have come just now.
  if (buffer_.canTransform(params_.odom_frame_id, params_.base_frame_id, scan.stamp)) return true;
  report({"scan too old", "scan of " + scan.frame_id + " at " + fixed(scan.stamp.toSec()) +
                              " s is older than what tf keeps" +
                              (reason.empty() ? "" : ": " + reason)});
  return false;
}

}  // namespace trident::estimation
