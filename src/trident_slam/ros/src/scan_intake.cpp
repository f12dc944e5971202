// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/scan_intake.h"

#include <tf2/exceptions.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_ros/message_checks.h"

namespace trident::slam {
namespace {

constexpr double kMountResolution = 1e-5;  // [m], [rad]: logs give mounts to this precision
/// A scan that need not be the newest waits for turning rates until later scans are so much
/// younger.
constexpr double kGyroPatience = 1.0;    // [s]
constexpr double kMinUprightness = 0.9;  // cosine of the tilt that a planar laser may have

/// Rounded, a mount from tf equals that of the same recording as a log.
double rounded(double value) { return std::round(value / kMountResolution) * kMountResolution; }

Eigen::Matrix3d rotation(const geometry_msgs::Quaternion& q) {
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
}

/// The heading is that of the x axis: it stays defined for any roll and pitch below 90 degrees.
SE2 planar(const geometry_msgs::Transform& T) {
  const Eigen::Vector3d x_axis = rotation(T.rotation).col(0);
  return SE2::from_xy_yaw(T.translation.x, T.translation.y, std::atan2(x_axis.y(), x_axis.x()));
}

std::string stamp_text(const ros::Time& stamp) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3f", stamp.toSec());
  return text;
}

/// A length of time as a user reads it, of three digits.
std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), seconds < 1e3 ? "%.3g" : "%.0f", seconds);
  return std::string(text) + " s";
}

void check(const sensor_msgs::LaserScan& message) {
  const std::string problem = ros_utils::scan_problem(message);
  if (!problem.empty()) throw Error(problem);
  if (message.angle_increment == 0.0F) throw Error("angle_increment 0 rad, legal: not 0");
}

}  // namespace

/// Upside down, the laser's z points down, and its angles count in the other direction.
LaserScan to_laser_scan(const sensor_msgs::LaserScan& message,
                        const geometry_msgs::Transform& T_base_laser) {
  check(message);
  const double up = rotation(T_base_laser.rotation)(2, 2);
  if (std::abs(up) < kMinUprightness) {
    throw Error("frame " + ros_utils::quoted(message.header.frame_id) + " is tilted by " +
                number_text(std::round(std::acos(up) * 180.0 / M_PI)) +
                " deg, legal: a laser that looks around in the plane");
  }
  const double turn = up > 0.0 ? 1.0 : -1.0;
  LaserScan scan;
  scan.stamp_ns = static_cast<std::int64_t>(message.header.stamp.toNSec());
  scan.angle_min = turn * message.angle_min;
  scan.angle_increment = turn * message.angle_increment;
  scan.time_increment = std::isfinite(message.time_increment) ? message.time_increment : 0.0;
  scan.range_min = message.range_min;
  scan.range_max = message.range_max;
  const SE2 mount = planar(T_base_laser);
  scan.T_base_laser =
      SE2::from_xy_yaw(rounded(mount.p.x()), rounded(mount.p.y()), rounded(mount.angle));
  scan.ranges = message.ranges;
  forget_readings_at_limit(scan);
  return scan;
}

bool ScanIntake::is_refused(const sensor_msgs::LaserScan& message, const ros::Time& now) {
  const std::string& frame = laser_frame(message);
  std::string problem = ros_utils::stamp_problem(message.header.stamp, now);
  if (problem.empty() && (frame.empty() || frame.front() == '/')) {
    problem = "frame_id is '" + ros_utils::quoted(frame) + "', legal: a name without / before it";
  }
  if (problem.empty()) return false;
  ++received_;
  leave_out(message, problem);
  return true;
}

void ScanIntake::leave_out_after(const ros::Time& stamp, const std::string& why) {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const bool is_after = (*it)->header.stamp > stamp;
    if (is_after) leave_out(**it, why);
    it = is_after ? waiting_.erase(it) : std::next(it);
  }
}

void ScanIntake::add(const sensor_msgs::LaserScanConstPtr& message) {
  if (is_refused(*message)) return;
  ++received_;
  waiting_.push_back(message);
  if (waiting_.size() <= options_.max_waiting) return;
  leave_out(*waiting_.front(), why_missing(*waiting_.front()));
  waiting_.pop_front();
}

/// The rate about the base's vertical is the third row of R_base_imu times the measured rate.
void ScanIntake::add(const sensor_msgs::Imu& message) {
  const std::string& imu = message.header.frame_id;
  imu_problem_ = ros_utils::stamp_problem(message.header.stamp, ros::Time());
  if (!imu.empty() && imu.front() == '/') imu_problem_ = "frame_id begins with /";
  if (!imu_problem_.empty()) return;
  const std::optional<Eigen::Matrix3d> R_base_imu = rotation_of_imu(imu);
  if (!R_base_imu) return;
  const auto& w = message.angular_velocity;
  const double rate = R_base_imu->row(2).dot(Eigen::Vector3d(w.x, w.y, w.z));
  imu_problem_ = std::isfinite(rate) ? "" : "angular_velocity is not finite";
  rates_.add(static_cast<std::int64_t>(message.header.stamp.toNSec()), rate);
}

/// How an IMU is mounted, which does not change; nothing, and a problem, where no transform says
/// so.
std::optional<Eigen::Matrix3d> ScanIntake::rotation_of_imu(const std::string& imu) {
  if (imu.empty() || imu == options_.base_frame) return Eigen::Matrix3d::Identity();
  const auto mount = find_transform(options_.base_frame, imu, ros::Time(0));
  if (mount) return rotation(mount->transform.rotation);
  imu_problem_ =
      "transform " + options_.base_frame + " -> " + ros_utils::quoted(imu) + " is not known at all";
  return std::nullopt;
}

/// Transforms come in a thread of their own, so that one that could be looked up need not be there
/// any more when it is: a frame may have got another parent.
std::optional<geometry_msgs::TransformStamped> ScanIntake::find_transform(
    const std::string& target, const std::string& source, const ros::Time& stamp) const {
  if (!transforms_.canTransform(target, source, stamp)) return std::nullopt;
  try {
    return transforms_.lookupTransform(target, source, stamp);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

/// From the front only, so that scans leave in the order in which they came.
std::vector<ScanRecord> ScanIntake::take() {
  std::vector<ScanRecord> records;
  while (!waiting_.empty()) {
    const sensor_msgs::LaserScan& message = *waiting_.front();
    ScanRecord record;
    try {
      if (resolve(message, record)) {
        if (!has_settled_gyro(record)) break;
        records.push_back(std::move(record));
      } else if (may_still_come(message)) {
        break;
      } else {
        // Transforms come in a thread of their own: the missing one may have come just now.
        const std::string why = why_missing(message);
        if (why.empty()) continue;
        leave_out(message, why);
      }
    } catch (const Error& error) {
      leave_out(message, error.what());
    }
    waiting_.pop_front();
  }
  return records;
}

std::vector<ScanRecord> ScanIntake::end() {
  has_ended_ = true;
  std::vector<ScanRecord> records = take();
  for (const auto& message : waiting_) leave_out(*message, why_missing(*message));
  waiting_.clear();
  return records;
}

void ScanIntake::clear() {
  waiting_.clear();
  rates_.clear();
}

const std::string& ScanIntake::laser_frame(const sensor_msgs::LaserScan& message) const {
  return options_.uses_mount ? message.header.frame_id : options_.base_frame;
}

std::vector<std::pair<std::string, std::string>> ScanIntake::needed(
    const sensor_msgs::LaserScan& message) const {
  std::vector<std::pair<std::string, std::string>> transforms;
  if (!options_.odom_frame.empty()) {
    transforms.emplace_back(options_.odom_frame, options_.base_frame);
  }
  transforms.emplace_back(options_.base_frame, laser_frame(message));
  return transforms;
}

/// All transforms at the scan's own stamp; none is extrapolated.
bool ScanIntake::resolve(const sensor_msgs::LaserScan& message, ScanRecord& record) {
  const ros::Time& stamp = message.header.stamp;
  if (!options_.odom_frame.empty()) {
    const auto pose = find_transform(options_.odom_frame, options_.base_frame, stamp);
    if (!pose) return false;
    record.T_odom_base = planar(pose->transform);
  }
  const auto mount = find_transform(options_.base_frame, laser_frame(message), stamp);
  if (!mount) return false;
  record.scan = to_laser_scan(message, mount->transform);
  return true;
}

/// A sweep is complete once the rates reach its end. It is not held up for ever by an IMU that has
/// failed: after the patience it goes without, and that is counted.
bool ScanIntake::has_settled_gyro(ScanRecord& record) {
  LaserScan& scan = record.scan;
  const double duration = sweep_duration(scan);
  if (!options_.uses_gyro || duration <= 0.0) return true;
  const std::int64_t end_ns = scan.stamp_ns + static_cast<std::int64_t>(1e9 * duration);
  scan.yaw_rate = rates_.mean(scan.stamp_ns, end_ns);
  if (scan.yaw_rate) return true;
  if (may_rates_come(end_ns)) return false;
  ++without_gyro_;
  add_problem("scan of " + stamp_text(waiting_.front()->header.stamp) +
              " s has no gyro: " + why_no_gyro(scan));
  return true;
}

bool ScanIntake::may_rates_come(std::int64_t end_ns) const {
  if (has_ended_ || rates_.newest_ns().value_or(0) >= end_ns) return false;
  const ros::Duration passed = waiting_.back()->header.stamp - waiting_.front()->header.stamp;
  const double patience = options_.waits_for_all ? kGyroPatience : options_.transform_timeout;
  return passed.toSec() <= patience;
}

std::string ScanIntake::why_no_gyro(const LaserScan& scan) const {
  if (!imu_problem_.empty()) return imu_problem_;
  const auto newest_ns = rates_.newest_ns();
  if (!newest_ns) return "no message of the IMU has come";
  const double end = 1e-9 * static_cast<double>(scan.stamp_ns - *newest_ns) + sweep_duration(scan);
  if (end > 0.0) {
    return "the newest rate is " + seconds_text(end) + " older than the end of the sweep";
  }
  return "rates leave a gap in the sweep, or begin after it did";
}

bool ScanIntake::may_still_come(const sensor_msgs::LaserScan& message) const {
  const ros::Time& stamp = message.header.stamp;
  if (!options_.waits_for_all) {
    const ros::Duration passed = waiting_.back()->header.stamp - stamp;
    return passed.toSec() <= options_.transform_timeout;
  }
  // As soon as both transforms have gone past the stamp, waiting is in vain.
  for (const auto& [target, source] : needed(message)) {
    if (transforms_.canTransform(target, source, stamp)) continue;
    const auto newest = find_transform(target, source, ros::Time(0));
    return !newest || newest->header.stamp < stamp;
  }
  return true;
}

std::string ScanIntake::why_missing(const sensor_msgs::LaserScan& message) const {
  const ros::Time& stamp = message.header.stamp;
  std::string why;
  for (const auto& [target, source] : needed(message)) {
    if (why.empty()) why = lateness(target, source, stamp);
  }
  return why;
}

/// The first stamp from which on a transform is known, by bisection: tf2 does not report it.
ros::Time ScanIntake::oldest_after(const std::string& target, const std::string& source,
                                   const ros::Time& unknown, const ros::Time& known) const {
  std::uint64_t low = unknown.toNSec();
  std::uint64_t high = known.toNSec();
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    const bool is_known = transforms_.canTransform(target, source, ros::Time().fromNSec(middle));
    (is_known ? high : low) = middle;
  }
  return ros::Time().fromNSec(high);
}

/// What a user can act on: which transform, whether it is late, too old or unknown, and by how
/// much.
std::string ScanIntake::lateness(const std::string& target, const std::string& source,
                                 const ros::Time& stamp) const {
  const std::string name = "transform " + target + " -> " + ros_utils::quoted(source);
  try {
    if (transforms_.canTransform(target, source, stamp)) return {};
    const ros::Time newest = transforms_.lookupTransform(target, source, ros::Time(0)).header.stamp;
    if (newest < stamp) {
      return name + " is late: the newest is " + seconds_text((stamp - newest).toSec()) +
             " older than the scan";
    }
    const ros::Time oldest = oldest_after(target, source, stamp, newest);
    return name + " is not known that far back: the oldest is " +
           seconds_text((oldest - stamp).toSec()) + " younger than the scan";
  } catch (const tf2::TransformException&) {
    return name + " is not known at all";
  }
}

void ScanIntake::add_problem(const std::string& problem) {
  last_problem_ = problem;
  problems_.add(problem);
}

void ScanIntake::leave_out(const sensor_msgs::LaserScan& message, const std::string& why) {
  ++left_out_;
  add_problem("scan of " + stamp_text(message.header.stamp) + " s is left out: " + why);
}

}  // namespace trident::slam
