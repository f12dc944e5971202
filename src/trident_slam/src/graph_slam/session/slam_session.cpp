// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// slam_session FILE: what a session of graph_slam_2d holds, as JSON; exit code 1 if it is damaged.
#include <cstdio>
#include <exception>
#include <iostream>
#include <vector>

#include "trident_base/shown_text.h"
#include "trident_slam/graph_slam_2d.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: slam_session FILE\n";
    return 2;
  }
  try {
    trident::slam::GraphSlam2d slam;
    slam.load_session(argv[1]);
    const std::vector<trident::slam::StampedPose2d> scans = slam.trajectory();
    const bool is_empty = scans.empty();
    std::printf(
        "{\"nodes\": %d, \"edges\": %zu, \"loops\": %d, \"scans\": %zu, \"first_stamp_ns\": %lld, "
        "\"last_stamp_ns\": %lld}\n",
        slam.nodes(), slam.graph_view().edges.size(), slam.loops_closed(), scans.size(),
        is_empty ? 0LL : static_cast<long long>(scans.front().stamp_ns),
        is_empty ? 0LL : static_cast<long long>(scans.back().stamp_ns));
  } catch (const std::exception& error) {
    std::cerr << "slam_session: " << trident::with_short_words(error.what()) << '\n';
    return 1;
  }
  return 0;
}
