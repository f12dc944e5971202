// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Between messages and the planner of trajectories.
#pragma once

#include <trident_msgs/OptimizeTrajectories.h>

#include <string>
#include <vector>

#include "trident_base/yaml_config.h"
#include "trident_trajectories/optimize.h"

namespace trident::trajectories {

/// A round obstacle of the constraints' YAML.
struct RequestedObstacle {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 1.0;                               ///< [m]
  bool sphere = false;                               ///< else an upright cylinder

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("center", center, Range::any(), "x, y, z [m]");
    ar.required("radius", radius, Range::positive(), "[m]");
    ar.field("sphere", sphere, "whether z counts; else it is an upright cylinder");
  }
};

/// Two robots that are near each other under path.
struct RequestedRendezvous {
  std::string first, second;                         ///< robots
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< first less second [m]
  double tolerance = 0.1;                            ///< [m]
  double fraction = 0.5;                             ///< of the duration

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("first", first, "robot");
    ar.required("second", second, "robot");
    ar.field("offset", offset, Range::any(), "of the first from the second [m]");
    ar.field("tolerance", tolerance, Range::positive(), "[m]");
    ar.field("fraction", fraction, Range{0.0, 1.0}, "of the duration");
  }
};

/// The YAML of OptimizeTrajectories.constraints.
struct RequestedConstraints {
  std::string cost = "jerk";                    ///< jerk, length, time, energy or mixed
  bool free_durations = false;                  ///< whether durations are chosen
  double downwash = 1.0;                        ///< by what heights between UAVs are divided
  double min_height = -1000.0;                  ///< of UAVs [m]
  int segments = 7;                             ///< of each curve
  bool free_place = false;                      ///< goals are places about a point that is chosen
  std::vector<RequestedObstacle> obstacles;     ///< that stand still
  std::vector<RequestedRendezvous> rendezvous;  ///< under path

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("cost", cost, "jerk, length, time, energy or mixed");
    ar.field("free_durations", free_durations,
             "whether durations are chosen, from a tenth to ten times those of the paths");
    ar.field("downwash", downwash, Range{1.0, 20.0},
             "by what the difference of height of two UAVs is divided");
    ar.field("min_height", min_height, Range{-1e4, 1e5}, "that UAVs keep above [m]");
    ar.field("segments", segments, Range{4.0, 60.0}, "polynomial pieces of each curve");
    ar.field("free_place", free_place, "whether goals are places about a point that is chosen");
    ar.field("obstacles", obstacles, "round things that stand still");
    ar.field("rendezvous", rendezvous, "pairs that are near each other under path");
  }
};

/// What is to be planned. Robots whose last times are equal share a duration. Throws Error naming
/// robot or key, field, value and what is legal.
Problem problem_of(const trident_msgs::OptimizeTrajectories::Request& request,
                   OptimizeOptions& options);

/// A trajectory as a path whose samples are `step_s` apart [s].
trident_msgs::TimedPath path_of(const Trajectory& trajectory,
                                const trident_msgs::TimedPath& initial, double step_s);

/// Plans. What is not legal is no exception but an answer without success; `is_refused` then says
/// so.
trident_msgs::OptimizeTrajectories::Response answer(
    const trident_msgs::OptimizeTrajectories::Request& request, bool& is_refused);

}  // namespace trident::trajectories
