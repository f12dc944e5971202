// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/carmen_log.h"

#include <cmath>
#include <utility>

#include "fields.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kDefaultRangeMax = 80.0;  // [m], SICK LMS; it reports 81.83 and 81.91 for nothing
constexpr std::size_t kMaxReadings = 100'000;
constexpr double kMaxMountShift = 0.01;    // [m] by which a mounted laser may seem to move
constexpr double kMaxMountTurn = 0.01;     // [rad]
constexpr double kMountResolution = 1e-5;  // logs have six decimals
constexpr double kMaxMountDistance = 3.0;  // [m] from the base

struct BeamAngles {
  double angle_min = -90.0 * kDegree;
  double angle_increment = kDegree;
};

// FLASER does not contain its angles. Scanners of that time start at -90 deg and give 180 / n deg
// steps with or without the last beam; 401 beams are the LMS' 100 deg at a quarter of a degree.
BeamAngles angles_of(std::size_t beams) {
  if (beams == 401) return {-50.0 * kDegree, 0.25 * kDegree};
  const std::size_t steps = beams % 2 == 1 && beams > 1 ? beams - 1 : beams;
  return {-90.0 * kDegree, 180.0 * kDegree / static_cast<double>(steps)};
}

bool read_pose(Fields& fields, SE2& pose) {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  if (!fields.finite(x) || !fields.finite(y) || !fields.finite(yaw)) return false;
  pose = SE2::from_xy_yaw(x, y, yaw);
  return true;
}

/// A count and as many readings. Returns what is wrong, empty when nothing is.
std::string read_ranges(Fields& fields, std::vector<float>& ranges) {
  std::size_t count = 0;
  if (!fields.count(count)) return "the number of readings is missing or not a number";
  if (count == 0 || count > kMaxReadings) {
    return "number of readings " + std::to_string(count) + ", legal: 1 to " +
           std::to_string(kMaxReadings);
  }
  ranges.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!fields.number(ranges[i])) {
      return "reading " + std::to_string(i + 1) + " of " + std::to_string(count) +
             " is missing or not a number";
    }
  }
  return {};
}

double rounded_to_log(double value) {
  return std::round(value / kMountResolution) * kMountResolution;
}

std::string read_poses(Fields& fields, SE2& T_odom_laser, SE2& T_odom_base) {
  if (!read_pose(fields, T_odom_laser)) return "the laser's pose is not three finite numbers";
  if (!read_pose(fields, T_odom_base)) return "the base's pose is not three finite numbers";
  return {};
}

/// What the log's parameters say, if they say something that can be.
double range_max_of(const std::map<std::string, double, std::less<>>& params, bool is_front) {
  const auto param = params.find(is_front ? "robot_front_laser_max" : "robot_rear_laser_max");
  return param != params.end() && param->second > 0.0 ? param->second : kDefaultRangeMax;
}

// All messages end with "ipc_timestamp ipc_hostname logger_timestamp".
std::string read_stamp(Fields& fields, ScanRecord& record) {
  if (!fields.stamp(record.scan.stamp_ns)) return "the timestamp is missing or not a number";
  return {};
}

/// Skips `count` numbers; false: there are not as many.
bool skip_numbers(Fields& fields, std::size_t count) {
  double skipped = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!fields.number(skipped)) return false;
  }
  return true;
}

/// The seven settings of ROBOTLASER: type start_angle field_of_view angular_resolution
/// maximum_range accuracy remission_mode. Returns what is wrong with them.
std::string read_settings(Fields& fields, LaserScan& scan, double& range_max) {
  const bool are_numbers = skip_numbers(fields, 1) && fields.finite(scan.angle_min) &&
                           skip_numbers(fields, 1) && fields.finite(scan.angle_increment) &&
                           fields.finite(range_max) && skip_numbers(fields, 2);
  if (!are_numbers) return "its seven settings are not numbers";
  if (scan.angle_increment == 0.0) return "angular_resolution is 0 rad";
  if (range_max <= 0.0) return "maximum_range " + number_text(range_max) + " m, legal: above 0";
  return {};
}

std::string skip_remissions(Fields& fields) {
  std::size_t count = 0;
  if (!fields.count(count)) return "the number of remissions is missing or not a number";
  return skip_numbers(fields, count) ? "" : "a remission is missing or not a number";
}

/// Skips tv rv forward_safety_distance side_safety_distance turn_axis.
std::string skip_motion(Fields& fields) {
  return skip_numbers(fields, 5) ? "" : "velocities or safety distances are missing";
}

}  // namespace

CarmenLog::CarmenLog(std::string path, Laser laser) : reader_(std::move(path)), laser_(laser) {}

bool CarmenLog::next(ScanRecord& record) {
  std::string_view line;
  while (reader_.next(line)) {
    if (read_line(line, record)) return true;
  }
  if (!reader_.damage().empty()) add_problem(reader_.damage());
  return false;
}

bool CarmenLog::read_line(std::string_view line, ScanRecord& record) {
  Fields fields(line);
  const std::string_view message = fields.word();
  if (message.empty() || message.front() == '#') return false;
  const std::string_view rest = line.substr(message.data() + message.size() - line.data());
  count(message);
  if (message == "PARAM") read_param(rest);
  if (!is_wanted(message)) return false;
  const bool has_angles = starts_with(message, "ROBOTLASER");
  const std::string error = has_angles ? read_robotlaser(rest, record) : read_flaser(rest, record);
  if (error.empty()) return true;
  add_problem(std::string(message) + ": " + error +
              (reader_.is_last_line_open() ? " (truncated file)" : ""));
  return false;
}

void CarmenLog::count(std::string_view message) {
  const auto counted = counts_.find(message);
  if (counted != counts_.end()) {
    ++counted->second;
  } else {
    counts_.emplace(message, 1);
  }
}

void CarmenLog::read_param(std::string_view rest) {
  Fields fields(rest);
  const std::string_view name = fields.word();
  double value = 0.0;
  if (fields.finite(value)) params_[std::string(name)] = value;
}

bool CarmenLog::is_wanted(std::string_view message) {
  const bool is_front = message == "FLASER" || message == "ROBOTLASER1";
  const bool is_rear = message == "RLASER" || message == "ROBOTLASER2";
  if (laser_ == Laser::kFront ? !is_front : !is_rear) return false;
  if (scan_message_.empty()) scan_message_ = message;
  return message == scan_message_;
}

/// The old format: ranges, poses and stamp, without angles or limits.
std::string CarmenLog::read_flaser(std::string_view rest, ScanRecord& record) {
  Fields fields(rest);
  Poses poses;
  std::string error = read_ranges(fields, record.scan.ranges);
  if (error.empty()) error = read_poses(fields, poses.T_odom_laser, poses.T_odom_base);
  if (error.empty()) error = read_stamp(fields, record);
  if (!error.empty()) return error;
  place_laser(poses, record);
  const BeamAngles angles = angles_of(record.scan.size());
  record.scan.angle_min = angles.angle_min;
  record.scan.angle_increment = angles.angle_increment;
  complete(record, range_max_of(params_, laser_ == Laser::kFront));
  return {};
}

/// The newer format, which says its angles and its range limit itself.
std::string CarmenLog::read_robotlaser(std::string_view rest, ScanRecord& record) {
  Fields fields(rest);
  double range_max = 0.0;
  Poses poses;
  std::string error = read_settings(fields, record.scan, range_max);
  if (error.empty()) error = read_ranges(fields, record.scan.ranges);
  if (error.empty()) error = skip_remissions(fields);
  if (error.empty()) error = read_poses(fields, poses.T_odom_laser, poses.T_odom_base);
  if (error.empty()) error = skip_motion(fields);
  if (error.empty()) error = read_stamp(fields, record);
  if (!error.empty()) return error;
  place_laser(poses, record);
  complete(record, range_max);
  return {};
}

// A mounted laser does not move: the first scan gives its pose. A log whose laser poses were
// corrected by somebody's SLAM has other ones in every line; there the offset parameter counts, as
// it does where the laser's pose is the base's.
void CarmenLog::place_laser(const Poses& poses, ScanRecord& record) {
  const SE2 T_base_laser = poses.T_odom_base.inverse() * poses.T_odom_laser;
  const bool is_one_pose = T_base_laser.p.isZero(0.0) && T_base_laser.angle == 0.0;
  if (!T_base_laser_) {
    is_one_pose_ = is_one_pose;
    T_base_laser_ = mount_of(T_base_laser, is_one_pose);
  }
  if (!is_one_pose_ || !is_one_pose) report_loose_laser(T_base_laser_->inverse() * T_base_laser);
  record.T_odom_base = poses.T_odom_base;
  record.scan.T_base_laser = *T_base_laser_;
}

/// The pose of the laser on the base, from that of the first scan. Two equal poses may be one that
/// was written twice: a parameter knows better.
SE2 CarmenLog::mount_of(const SE2& T_base_laser, bool is_one_pose) const {
  const double offset = offset_of_params();
  if (T_base_laser.p.norm() > kMaxMountDistance || (is_one_pose && offset != 0.0)) {
    return SE2::from_xy_yaw(offset, 0.0, laser_ == Laser::kFront ? 0.0 : 180.0 * kDegree);
  }
  return SE2::from_xy_yaw(rounded_to_log(T_base_laser.p.x()), rounded_to_log(T_base_laser.p.y()),
                          rounded_to_log(T_base_laser.angle));
}

/// Once per log.
void CarmenLog::report_loose_laser(const SE2& moved) {
  const bool is_loose = moved.p.norm() > kMaxMountShift || std::abs(moved.angle) > kMaxMountTurn;
  if (has_reported_loose_laser_ || !is_loose) return;
  has_reported_loose_laser_ = true;
  add_problem("the laser moves on the base by " + number_text(moved.p.norm()) + " m, " +
              number_text(moved.angle) + " rad; its first place is kept");
}

/// Names the line that was read last.
void CarmenLog::add_problem(const std::string& problem) {
  problems_.add(reader_.path() + ":" + std::to_string(reader_.line_number()) + ": " + problem);
}

double CarmenLog::offset_of_params() const {
  const auto param =
      params_.find(laser_ == Laser::kFront ? "robot_frontlaser_offset" : "robot_rearlaser_offset");
  return param != params_.end() ? param->second : 0.0;
}

void CarmenLog::complete(ScanRecord& record, double range_max) const {
  const auto param = [this](std::string_view name, double fallback) {
    const auto found = params_.find(name);
    return found != params_.end() ? found->second : fallback;
  };
  LaserScan& scan = record.scan;
  scan.range_min = param("laser_range_min", 0.0);
  scan.range_max = param("laser_range_max", range_max);
  scan.time_increment = param("laser_time_increment", 0.0);
  forget_readings_at_limit(scan);
}

}  // namespace trident::slam
