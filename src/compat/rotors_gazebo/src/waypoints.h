// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace trident::control {

struct Waypoint {
  double wait_s = 0.0;               ///< time since the one before [s]
  double x = 0.0, y = 0.0, z = 0.0;  ///< [m, world]
  double yaw = 0.0;                  ///< [rad]
};

/// Reads lines `wait_time x y z yaw_deg`, separated by blanks, tabs or commas; empty lines and
/// those that begin with # are skipped. Throws std::runtime_error naming `name`, line, text and
/// what is legal.
std::vector<Waypoint> read_waypoints(std::istream& in, const std::string& name);

/// Reads `x y z yaw_deg` from the command line. Throws std::runtime_error naming the word.
Waypoint waypoint_from_words(const std::vector<std::string>& words);

/// A number of seconds from 0 to 10^9, errors as of `parse_number`.
double parse_wait(const std::string& text, const std::string& what);

/// A finite number that is the whole of `text`; throws std::runtime_error naming `what` and `text`.
double parse_number(const std::string& text, const std::string& what);

}  // namespace trident::control
