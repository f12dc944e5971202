// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"

// What some algorithms can do beyond Slam2d. An algorithm inherits from what it has; who holds a
// Slam2d asks with dynamic_cast.

namespace trident::slam {

/// Where the robot is when a session has been read: where the session ended; at its first node; at
/// a given pose; at a given pose, and from then on the map does not change.
enum class SessionStart { kSessionEnd, kFirstNode, kGivenPose, kLocalize };

/// A map that can be kept in a file and continued.
class Slam2dSession {
 public:
  virtual ~Slam2dSession() = default;
  /// The file is never seen half written. Throws Error when it cannot be written.
  virtual void save_session(const std::string& file) const = 0;
  /// The same in two steps: this call is quick, what it returns writes the session as it is now, in
  /// any thread, while scans arrive.
  virtual std::function<void(const std::string&)> session_snapshot() const = 0;
  /// `T_map_base`: the given pose, not read for other starts. Throws Error when the file is damaged
  /// or of an unknown version, or no map can continue from that pose; the map is then as before.
  virtual void load_session(const std::string& file, SessionStart start, const SE2& T_map_base) = 0;
};

/// A map that is made while scans arrive.
class Slam2dMapSnapshot {
 public:
  virtual ~Slam2dMapSnapshot() = default;
  /// This call is quick; what it returns makes the map as it is now, in any thread.
  virtual std::function<OccupancyGrid()> map_snapshot() const = 0;
};

/// A robot whose pose can be set from outside.
class PoseInitializable {
 public:
  virtual ~PoseInitializable() = default;
  /// The base at the next scan, roughly.
  virtual void set_pose(const SE2& T_map_base) = 0;
};

/// A robot that is searched for in a map with the help of its last scans.
class Slam2dLocalizing {
 public:
  virtual ~Slam2dLocalizing() = default;
  /// Forgets these scans.
  virtual void clear_localization_buffer() = 0;
};

/// A method that can do without odometry.
class Slam2dOdometryUse {
 public:
  virtual ~Slam2dOdometryUse() = default;
  /// False: poses by scans alone, whatever odometry says.
  virtual void set_uses_odometry(bool uses_odometry) = 0;
};

/// What was found out about the robot while it drove.
struct CalibrationEstimate {
  const char* name = "";     ///< distance_scale, turn_scale, yaw_drift [rad/m], laser_x [m] ...
  double value = 0.0;        ///< mean, in the unit that the name implies
  double sigma = 0.0;        ///< standard deviation
  bool is_observed = false;  ///< false: the motions so far do not show it
};

/// Odometry that is calibrated online.
class Slam2dCalibrated {
 public:
  virtual ~Slam2dCalibrated() = default;
  /// Empty where nothing is estimated.
  virtual std::vector<CalibrationEstimate> odometry_calibration() const = 0;
};

/// The nodes of a pose graph (the base when a keyframe was seen) and its edges, to be looked at.
struct GraphView2d {
  /// A measurement between two nodes.
  struct Edge {
    int from = 0;          ///< index of a node
    int to = 0;            ///< index of a node
    bool is_loop = false;  ///< not between successive nodes
  };
  std::vector<SE2> nodes;   ///< T_map_base
  std::vector<Edge> edges;  ///< in the order in which they were added
};

/// A place that was seen again, as it was measured when that was believed.
struct GraphLoop2d {
  std::size_t older = 0;  ///< scan, as `Slam2d::trajectory` counts them
  std::size_t newer = 0;  ///< counted as `older`
  SE2 T_older_newer;      ///< between the base at these scans
  bool is_found = false;  ///< by the search for loops; false: the surfaces were never lost
};

/// A map that is made from a pose graph.
class Slam2dGraph {
 public:
  virtual ~Slam2dGraph() = default;
  /// A copy of the graph as it is now.
  virtual GraphView2d graph_view() const = 0;
  /// All that are believed now, in the order in which they were found.
  virtual std::vector<GraphLoop2d> loops() const = 0;
  /// Writes the graph in g2o's format. Throws Error when the file cannot be written.
  virtual void save_g2o(const std::string& file) const = 0;
};

/// A graph that a user may correct.
class GraphEditable {
 public:
  virtual ~GraphEditable() = default;
  /// What a node saw, in its own frame [m]. Throws Error for an unknown node.
  virtual std::vector<Eigen::Vector2f> node_points(int node) const = 0;
  /// Ties nodes to what lies where they were moved. Returns those that did not fit there: they
  /// stay. Throws Error for an unknown node.
  virtual std::vector<int> move_nodes(const std::map<int, SE2>& T_map_base) = 0;
  /// Matches all scans that see the same surfaces with each other and optimises the whole graph, as
  /// `Slam2d::finish` does; in the background where the algorithm works there while scans arrive.
  virtual void realign() = 0;
};

}  // namespace trident::slam
