// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trident_slam/line_reader.h"
#include "trident_slam/scan_source.h"

namespace trident::slam {

/// Reader of logs of the CARMEN robot navigation toolkit (.log, .clf; plain, gzip, bzip2), line by
/// line, in file order: stamps are labels and may go backwards.
///
/// - FLASER (front) and RLASER (rear): ranges, the laser's and the base's odometry pose. Where the
///   laser sits on the base comes from these two poses of the first scan. The number of beams gives
///   the angles, as SICK LMS scanners have them: beam 0 points to the right (-90 deg), beams are
///   180 deg / 180 apart up to 181 of them, 180 deg / 360 up to 361, and so on.
/// - ROBOTLASER1 (front) and ROBOTLASER2 (rear): they carry angles and range limit themselves.
/// - PARAM: robot_front_laser_max, robot_rear_laser_max [m], robot_frontlaser_offset,
///   robot_rearlaser_offset [m]; laser_range_min, laser_range_max [m], laser_time_increment [s]
///   (Trident's own: what sensor_msgs/LaserScan has beyond CARMEN's messages).
/// - ODOM and every other message is passed over: each scan carries its odometry.
///
/// A reading at or above the range limit is no return and given out as infinite. A line that cannot
/// be read is counted and named in `problems`, and reading continues.
class CarmenLog : public ScanSource {
 public:
  /// Which of the robot's lasers is read: a log of two is read twice.
  enum class Laser { kFront, kRear };

  /// "-" is the standard input. Throws Error when the file cannot be opened.
  explicit CarmenLog(std::string path, Laser laser = Laser::kFront);

  bool next(ScanRecord& record) override;
  const LogProblems& problems() const override { return problems_; }
  double progress() const override { return reader_.progress(); }
  /// Lines read so far, by message name.
  const std::map<std::string, std::size_t, std::less<>>& message_counts() const { return counts_; }

 private:
  struct Poses {
    SE2 T_odom_laser;
    SE2 T_odom_base;
  };
  bool read_line(std::string_view line, ScanRecord& record);
  void read_param(std::string_view line);
  bool is_wanted(std::string_view message);
  std::string read_flaser(std::string_view rest, ScanRecord& record);
  std::string read_robotlaser(std::string_view rest, ScanRecord& record);
  void count(std::string_view message);
  void add_problem(const std::string& problem);
  void place_laser(const Poses& poses, ScanRecord& record);
  SE2 mount_of(const SE2& T_base_laser, bool is_one_pose) const;
  void report_loose_laser(const SE2& moved);
  /// Where the laser sits ahead of the base, 0 without a word of it [m].
  double offset_of_params() const;
  void complete(ScanRecord& record, double range_max) const;

  LineReader reader_;
  Laser laser_;
  LogProblems problems_;
  std::map<std::string, std::size_t, std::less<>> counts_;
  std::string scan_message_;  // the first kind of scan that came: the others repeat it
  std::optional<SE2> T_base_laser_;
  bool is_one_pose_ = false;  // the first scan's poses of laser and base
  bool has_reported_loose_laser_ = false;
  std::map<std::string, double, std::less<>> params_;
};

}  // namespace trident::slam
