// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "graph_slam/backend/keyframe_graph.h"
#include "graph_slam/local/scan_archive.h"

namespace trident::slam {

/// All that a session file holds. A copy shares the scans of the keyframes with its original.
struct Session {
  KeyframeGraph graph;
  ScanArchive archive;
  SE2 T_map_base;          ///< pose of the newest scan
  double travelled = 0.0;  ///< path length of the robot so far [m]

  /// Appends everything to `writer`; the order of the numbers is the file format.
  void save(BinaryWriter* writer) const;
  /// Throws Error, and then nothing has changed.
  void load(BinaryReader* reader);
};

}  // namespace trident::slam
