// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_slam/scan_source.h"
#include "trident_slam/sweep_motion.h"

namespace trident::slam {

/// The planar scan in a message. A laser that hangs upside down reverses the order of its
/// beams. Throws Error naming the field, its value and what is legal.
LaserScan to_laser_scan(const sensor_msgs::LaserScan& message,
                        const geometry_msgs::Transform& T_base_laser);

/// Which transforms a scan needs, and how long it waits for them.
struct ScanIntakeOptions {
  std::string odom_frame = "odom";            ///< empty: no odometry, its poses are the identity
  std::string base_frame = "base_footprint";  ///< whose poses the algorithm is given
  double transform_timeout = 0.2;             ///< [s] that a transform may come after its scan
  bool waits_for_all = false;      ///< true: a scan waits as long as its transform may still come
  bool uses_mount = true;          ///< false: the laser is taken to sit at the base frame
  bool uses_gyro = false;          ///< a sweep waits for the turning rates until its end, too
  std::size_t max_waiting = 1000;  ///< scans that wait at most
};

/// Scans wait here until the transforms of their stamps are known, in the order in which they
/// came. A transform that is missing is never replaced: its scan is left out, and `problems` says
/// which transform is late and by how much. No clock: how late is judged by the newest scan. A
/// sweep whose turning rates are missing is used without them, and that is reported.
class ScanIntake {
 public:
  /// `transforms` must outlive it; it is filled by the caller.
  ScanIntake(const ScanIntakeOptions& options, const tf2::BufferCore& transforms)
      : options_(options), transforms_(transforms) {}

  /// Whether a scan can never be used, whatever transforms come: it is left out and reported.
  /// `now`: of the clock; zero: not known.
  bool is_refused(const sensor_msgs::LaserScan& message, const ros::Time& now = {});
  /// Appends a scan. Where too many wait, the oldest is left out and reported.
  void add(const sensor_msgs::LaserScanConstPtr& message);
  /// Leaves out what waits and is newer than this.
  void leave_out_after(const ros::Time& stamp, const std::string& why);
  /// The turning rate of a gyro, which may be mounted in any orientation, if its transform is
  /// known.
  void add(const sensor_msgs::Imu& message);
  /// All scans from the front whose transforms are known.
  std::vector<ScanRecord> take();
  /// At the end of a log nothing more will come: scans that wait for turning rates alone are taken,
  /// what else still waits is left out.
  std::vector<ScanRecord> end();
  /// After time went back: forgets what waits.
  void clear();

  std::size_t received() const { return received_; }       ///< scans that were added
  std::size_t waiting() const { return waiting_.size(); }  ///< scans, now
  std::size_t left_out() const { return left_out_; }       ///< scans, all of them in problems()
  /// Scans used without the turning rates asked for.
  std::size_t without_gyro() const { return without_gyro_; }
  /// Since the beginning; clear() keeps them.
  const LogProblems& problems() const { return problems_; }
  /// The last problem's text.
  const std::string& last_problem() const { return last_problem_; }

 private:
  const std::string& laser_frame(const sensor_msgs::LaserScan& message) const;
  bool resolve(const sensor_msgs::LaserScan& message, ScanRecord& record);
  /// The transforms that a scan needs, as target and source.
  std::vector<std::pair<std::string, std::string>> needed(
      const sensor_msgs::LaserScan& message) const;
  bool may_still_come(const sensor_msgs::LaserScan& message) const;
  /// False while rates may still come; else the record has its rate, or the reason is reported.
  bool has_settled_gyro(ScanRecord& record);
  std::optional<Eigen::Matrix3d> rotation_of_imu(const std::string& imu);
  std::optional<geometry_msgs::TransformStamped> find_transform(const std::string& target,
                                                                const std::string& source,
                                                                const ros::Time& stamp) const;
  /// Whether the yaw rates up to a time are still worth waiting for.
  bool may_rates_come(std::int64_t end_ns) const;
  std::string why_missing(const sensor_msgs::LaserScan& message) const;
  ros::Time oldest_after(const std::string& target, const std::string& source,
                         const ros::Time& unknown, const ros::Time& known) const;
  std::string lateness(const std::string& target, const std::string& source,
                       const ros::Time& stamp) const;
  std::string why_no_gyro(const LaserScan& scan) const;
  void add_problem(const std::string& problem);
  void leave_out(const sensor_msgs::LaserScan& message, const std::string& why);

  ScanIntakeOptions options_;
  const tf2::BufferCore& transforms_;
  std::deque<sensor_msgs::LaserScanConstPtr> waiting_;
  YawRates rates_;
  std::string imu_problem_;  ///< why no rate could be taken of the last message, if so
  bool has_ended_ = false;
  std::size_t received_ = 0;
  std::size_t left_out_ = 0;
  std::size_t without_gyro_ = 0;
  LogProblems problems_;
  std::string last_problem_;
};

}  // namespace trident::slam
