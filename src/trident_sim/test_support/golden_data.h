// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trident_base/se3.h"
#include "trident_base/sim_time.h"

namespace trident::sim {

// Flights of Gazebo 11 with RotorS, recorded for comparison. They are not part of the repository.

/// The folder with the recordings: $TRIDENT_DATA/../golden, or the sibling `shared` of the
/// repository; "" if neither exists.
std::string golden_folder();
std::string golden_hint();

#define TRIDENT_NEEDS_GOLDEN()                                  \
  do {                                                          \
    if (golden_folder().empty()) GTEST_SKIP() << golden_hint(); \
  } while (false)

std::string read_file(const std::string& path);
/// Numbers below the header line.
std::vector<std::vector<double>> read_csv(const std::string& path);

struct FlightRow {
  double t_s = 0.0;        ///< since the set-point of the case
  std::uint64_t step = 0;  ///< of the simulation
  SE3 T_world_base;
  Eigen::Vector3d v_world, w_base;
  std::array<double, 6> rotor_rad_s{};
};
std::vector<FlightRow> read_flight(const std::string& path, double dt_s);

struct RecordedCommand {
  SimTime stamp;  ///< of the odometry it answers
  std::array<double, 6> rotor_rad_s{};
};
std::vector<RecordedCommand> read_commands(const std::string& path);

/// Largest distance and angle between two motions.
struct Deviation {
  double position_m = 0.0, angle_deg = 0.0;
  void add(const SE3& a, const SE3& b);
};

}  // namespace trident::sim
