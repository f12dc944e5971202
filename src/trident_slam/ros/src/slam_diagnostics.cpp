// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <cctype>
#include <cmath>
#include <utility>

#include "trident_base/string_util.h"
#include "trident_slam_ros/motion_diagnosis.h"

namespace trident::slam {
namespace {

using Status = diagnostic_msgs::DiagnosticStatus;

constexpr double kPublishPeriod_s = 1.0;  // wall time
constexpr double kWarningPeriod_s = 5.0;
constexpr std::size_t kMaxKinds = 100;  // names in foreign messages make ever more kinds

diagnostic_msgs::KeyValue key_value(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = value;
  return pair;
}

/// Returns a problem's text without its numbers, what it quotes and what it has in brackets.
std::string kind_of(const std::string& text) {
  std::string kind;
  bool is_quoted = false;
  int depth = 0;
  for (const char letter : text) {
    if (letter == '\'') is_quoted = !is_quoted;
    if (letter == '(') ++depth;
    if (letter == ')') --depth;
    const bool is_digit = std::isdigit(static_cast<unsigned char>(letter)) != 0;
    if (!is_quoted && depth <= 0 && !is_digit) kind += letter;
  }
  return kind;
}

std::string text(const CalibrationEstimate& estimate) {
  if (!estimate.is_observed) return "not observable yet";
  const auto rounded = [](double value) { return number_text(std::round(1e5 * value) / 1e5); };
  return rounded(estimate.value) + " +- " + rounded(estimate.sigma);
}

}  // namespace

SlamDiagnostics::SlamDiagnostics(ros::NodeHandle node)
    : publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {}

void SlamDiagnostics::start(ros::NodeHandle node, std::function<ScanCounts()> counts) {
  timer_ = node.createWallTimer(
      ros::WallDuration(kPublishPeriod_s),
      [this, counts = std::move(counts)](const ros::WallTimerEvent&) { publish(counts()); });
}

void SlamDiagnostics::report(const std::string& problem) {
  const Lock lock(mutex_);
  add_problem(problem);
  warn_throttled(problem);
}

void SlamDiagnostics::warn(const std::string& problem) {
  const Lock lock(mutex_);
  last_problem_ = problem;
  warn_throttled(problem);
}

void SlamDiagnostics::count(const std::string& problem) {
  const Lock lock(mutex_);
  add_problem(problem);
}

void SlamDiagnostics::add_scan(const ScanPose2d& pose,
                               std::vector<CalibrationEstimate> calibration) {
  const Lock lock(mutex_);
  calibration_ = std::move(calibration);
  newest_ = pose;
  ++used_;
  if (pose.problem.empty()) return;
  add_problem(pose.problem);
  warn_throttled(pose.problem);
}

void SlamDiagnostics::add_problem(const std::string& problem) {
  problems_.add(problem);
  last_problem_ = problem;
}

void SlamDiagnostics::warn_throttled(const std::string& problem) {
  std::string kind = kind_of(problem);
  const ros::WallTime now = ros::WallTime::now();
  if (last_warning_.size() >= kMaxKinds && last_warning_.count(kind) == 0) kind.clear();
  ros::WallTime& last = last_warning_[kind];
  if (!last.isZero() && (now - last).toSec() < kWarningPeriod_s) return;
  last = now;
  ROS_WARN("%s", problem.c_str());
}

void SlamDiagnostics::publish(const ScanCounts& counts) {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status.resize(1);
  Status& status = array.status[0];
  status.name = ros::this_node::getName().substr(1) + ": SLAM";
  status.hardware_id = "none";
  {
    const Lock lock(mutex_);
    set_level(counts, status);
    add_values(counts, status);
  }
  publisher_.publish(array);
}

void SlamDiagnostics::set_level(const ScanCounts& counts, Status& status) {
  const std::size_t problems = problems_.count() + counts.problems;
  const bool is_worse = problems > published_problems_;
  published_problems_ = problems;
  status.level = is_worse ? Status::WARN : Status::OK;
  status.message = is_worse ? last_problem_ : (used_ == 0 ? "no scan yet" : "mapping");
  const std::string warning = diagnose_motion(newest_).warning;
  if (!is_worse && !warning.empty()) {
    status.level = Status::WARN;
    status.message = warning;
  }
  if (counts.is_paused) status.message = "paused";
}

void SlamDiagnostics::add_values(const ScanCounts& counts, Status& status) const {
  const MotionDiagnosis motion = diagnose_motion(newest_);
  const auto text_of = [](std::size_t count) { return std::to_string(count); };
  status.values = {
      key_value("scans received", text_of(counts.received)),
      key_value("scans used", text_of(used_)),
      key_value("scans waiting for transforms", text_of(counts.waiting_for_transforms)),
      key_value("scans waiting for SLAM", text_of(counts.waiting_for_slam)),
      key_value("scans replaced by newer ones", text_of(counts.replaced)),
      key_value("scans left out", text_of(counts.left_out)),
      key_value("scans without gyro", text_of(counts.without_gyro)),
      key_value("motion between scans by", motion.motion_by),
      key_value("direction left open", motion.open),
      key_value("problems", text_of(problems_.count())),
      key_value("last problem", last_problem_)};
  for (const CalibrationEstimate& estimate : calibration_) {
    status.values.push_back(key_value(std::string("odometry: ") + estimate.name, text(estimate)));
  }
}

}  // namespace trident::slam
