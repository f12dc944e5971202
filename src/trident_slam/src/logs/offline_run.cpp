// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/offline_run.h"

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "process_cost.h"
#include "stamp_check.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_maps/map_file.h"

namespace trident::slam {
namespace {

constexpr std::int64_t kMicrosecond = 1'000;
constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;

class TumFile {
 public:
  explicit TumFile(std::string path) : path_(std::move(path)), file_(path_) { check(); }
  void write(const StampedPose2d& pose) {
    file_ << tum_line(pose) << '\n';
    check();
  }
  void close() {
    file_.close();
    check();
  }

 private:
  void check() const {
    if (!file_) throw Error(path_ + ": cannot be written");
  }
  std::string path_;
  std::ofstream file_;
};

}  // namespace

std::string tum_line(const StampedPose2d& pose) {
  const std::int64_t half = pose.stamp_ns < 0 ? -kMicrosecond / 2 : kMicrosecond / 2;
  const std::int64_t stamp_us = (pose.stamp_ns + half) / kMicrosecond;
  const SE2& T = pose.T_map_base;
  char line[256];
  std::snprintf(line, sizeof(line),
                "%s%" PRId64 ".%06" PRId64 " %.6f %.6f 0.000000 0.000000 0.000000 %.6f %.6f",
                stamp_us < 0 ? "-" : "", std::abs(stamp_us) / kMicrosecondsPerSecond,
                std::abs(stamp_us) % kMicrosecondsPerSecond, T.p.x(), T.p.y(),
                std::sin(0.5 * T.angle), std::cos(0.5 * T.angle));
  return line;
}

namespace {

void write_loops(const Slam2dGraph& slam, const std::string& path) {
  std::ofstream file(path);
  file << "older_scan,newer_scan,x,y,yaw,kind\n";
  for (const GraphLoop2d& loop : slam.loops()) {
    char line[160];
    std::snprintf(line, sizeof(line), "%zu,%zu,%.6f,%.6f,%.6f,%s\n", loop.older, loop.newer,
                  loop.T_older_newer.p.x(), loop.T_older_newer.p.y(), loop.T_older_newer.angle,
                  loop.is_found ? "loop" : "reuse");
    file << line;
  }
  file.flush();
  if (!file) throw Error(path + ": cannot be written");
}

void write_trajectory(const std::vector<StampedPose2d>& poses, const std::string& path) {
  TumFile file(path);
  for (const StampedPose2d& pose : poses) file.write(pose);
  file.close();
}

void note_scan(const ScanPose2d& pose, double cpu_s, OfflineResult& result) {
  ++result.scans;
  if (cpu_s > result.slowest_scan_cpu_s) {
    result.slowest_scan_cpu_s = cpu_s;
    result.slowest_scan = result.scans;
  }
  if (!pose.is_used) ++result.unused_scans;
  if (!pose.problem.empty()) {
    result.scan_problems.add("scan " + std::to_string(result.scans) + ": " + pose.problem);
  }
}

/// Of the scans behind the first `known_before`; poses as they came where the method keeps none.
void write_results(const Slam2d& slam, std::size_t known_before,
                   const std::vector<StampedPose2d>& causal, const std::string& out_dir) {
  std::vector<StampedPose2d> poses = slam.trajectory();
  poses.erase(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(known_before));
  write_trajectory(poses.empty() ? causal : poses, out_dir + "/trajectory.tum");
  maps::save_map(out_dir + "/map", slam.map());
  if (const auto* graph = dynamic_cast<const Slam2dGraph*>(&slam)) {
    graph->save_g2o(out_dir + "/graph.g2o");
    write_loops(*graph, out_dir + "/loops.csv");
  }
}

}  // namespace

/// The causal trajectory holds each pose as it was known with its scan, the final one as loops have
/// corrected it; both are written, as they answer different questions.
OfflineResult run_offline(ScanSource& source, Slam2d& slam, const std::string& out_dir,
                          const OfflineProgress& progress, const OfflineScanBegins& begins) {
  OfflineResult result;
  const std::size_t known_before = slam.trajectory().size();
  TumFile causal_file(out_dir + "/causal.tum");
  std::vector<StampedPose2d> causal;
  ScanRecord record;
  StampCheck stamps;
  while (source.next(record)) {
    stamps.add(record.scan.stamp_ns);
    if (begins) begins(result.scans + 1, record.scan.stamp_ns);
    const double cpu_before_s = process_cpu_s();
    const ScanPose2d pose = slam.add_scan(record.scan, record.T_odom_base);
    note_scan(pose, process_cpu_s() - cpu_before_s, result);
    causal.push_back({record.scan.stamp_ns, pose.T_map_base});
    causal_file.write(causal.back());
    if (progress) progress(result.scans, source.progress());
  }
  causal_file.close();
  result.stamps_back = stamps.back();
  result.stamp_jumps = stamps.jumps();
  result.stamp_problem = stamps.text();
  if (result.scans == 0) throw Error("the log has no scan that can be read");
  slam.finish();
  write_results(slam, known_before, causal, out_dir);
  if (const auto* calibrated = dynamic_cast<const Slam2dCalibrated*>(&slam)) {
    result.odometry_calibration = calibrated->odometry_calibration();
  }
  return result;
}

}  // namespace trident::slam
