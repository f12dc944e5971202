// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trident_slam/scan_source.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

/// What became of the scans of a log.
struct OfflineResult {
  std::size_t scans = 0;            ///< all, used or not
  std::size_t unused_scans = 0;     ///< no usable return: the pose is odometry's
  std::size_t stamps_back = 0;      ///< stamps before the one of the scan before
  std::size_t stamp_jumps = 0;      ///< more than ten seconds after it
  std::string stamp_problem;        ///< empty, or which, as one line
  std::size_t slowest_scan = 0;     ///< that cost the most, from 1
  double slowest_scan_cpu_s = 0.0;  ///< of that scan, all threads of the process [s]
  LogProblems scan_problems;        ///< what the algorithm said about scans
  std::vector<CalibrationEstimate> odometry_calibration;  ///< empty where nothing is estimated
};

/// Called after every scan with the number of scans so far and the part of the log that is read.
using OfflineProgress = std::function<void(std::size_t scans, double part)>;
/// Called before a scan is worked on, with its number, from 1.
using OfflineScanBegins = std::function<void(std::size_t scan, std::int64_t stamp_ns)>;

/// Feeds a whole log to an algorithm and writes what came out into an existing folder:
/// causal.tum (base poses as returned by `add_scan`, written as they come), trajectory.tum (base
/// poses of these scans at the end; those of causal.tum where the map is only localised in),
/// map.pgm, map.yaml and, of a Slam2dGraph, graph.g2o and loops.csv (scans by their lines in
/// trajectory.tum, the newer one's pose in the older one's frame). Throws Error when a file cannot
/// be written or the log has no scan.
OfflineResult run_offline(ScanSource& source, Slam2d& slam, const std::string& out_dir,
                          const OfflineProgress& progress, const OfflineScanBegins& begins = {});

/// One line of a TUM trajectory: "stamp x y z qx qy qz qw", six decimals.
std::string tum_line(const StampedPose2d& pose);

}  // namespace trident::slam
