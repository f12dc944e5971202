// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/offline_run.h"

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_estimation/map_file.h"
#include "trident_slam/graph_slam_2d.h"

namespace trident {
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

OfflineResult run_offline(ScanSource& source, Slam2d& slam, const std::string& out_dir,
                          const OfflineProgress& progress) {
  OfflineResult result;
  TumFile causal(out_dir + "/causal.tum");
  ScanRecord record;
  while (source.next(record)) {
    const ScanPose2d pose = slam.add_scan(record.scan, record.T_odom_base);
    causal.write({record.scan.stamp_ns, pose.T_map_base});
    ++result.scans;
    if (!pose.is_used) ++result.unused_scans;
    if (!pose.problem.empty()) {
      result.scan_problems.add("scan " + std::to_string(result.scans) + ": " + pose.problem);
    }
    if (progress) progress(result.scans, source.progress());
  }
  causal.close();
  if (result.scans == 0) throw Error("the log has no scan that can be read");
  slam.finish();
  TumFile final_poses(out_dir + "/trajectory.tum");
  for (const StampedPose2d& pose : slam.trajectory()) final_poses.write(pose);
  final_poses.close();
  save_map(out_dir + "/map", slam.map());
  if (const auto* graph = dynamic_cast<const GraphSlam2d*>(&slam)) {
    graph->save_g2o(out_dir + "/graph.g2o");
  }
  return result;
}

}  // namespace trident
