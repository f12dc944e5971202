// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "waypoints.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace trident::control {
namespace {

constexpr double kRadiansPerDegree = M_PI / 180.0;
constexpr double kLongestWait_s = 1e9;  // a ros::Duration has 32 bits of seconds

std::vector<std::string> words_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), std::istream_iterator<std::string>()};
}

Waypoint waypoint_from_line(const std::vector<std::string>& words, const std::string& where) {
  if (words.size() != 5) {
    throw std::runtime_error(where + " has " + std::to_string(words.size()) +
                             " values: it must have 5, wait_time x y z yaw_deg");
  }
  const double wait_s = parse_wait(words[0], where + ", wait_time");
  return {wait_s, parse_number(words[1], where + ", x"), parse_number(words[2], where + ", y"),
          parse_number(words[3], where + ", z"),
          parse_number(words[4], where + ", yaw_deg") * kRadiansPerDegree};
}

}  // namespace

double parse_number(const std::string& text, const std::string& what) {
  try {
    std::size_t used = 0;
    const double number = std::stod(text, &used);
    if (used == text.size() && std::isfinite(number)) return number;
  } catch (const std::logic_error&) {  // not a number, or out of range: the error below
  }
  throw std::runtime_error(what + " is '" + text + "': it must be a finite number");
}

double parse_wait(const std::string& text, const std::string& what) {
  const double wait_s = parse_number(text, what);
  if (wait_s >= 0.0 && wait_s <= kLongestWait_s) return wait_s;
  throw std::runtime_error(what + " is " + text + ": it must be >= 0 s, <= 1e9 s");
}

std::vector<Waypoint> read_waypoints(std::istream& in, const std::string& name) {
  std::vector<Waypoint> waypoints;
  std::string line;
  double sum_s = 0.0;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words.front().front() == '#') continue;
    const std::string where = name + ", line " + std::to_string(number);
    waypoints.push_back(waypoint_from_line(words, where));
    sum_s += waypoints.back().wait_s;
    if (sum_s > kLongestWait_s) {
      throw std::runtime_error(where + ": the waits up to here are more than 1e9 s");
    }
  }
  if (waypoints.empty()) throw std::runtime_error(name + " has no waypoints");
  return waypoints;
}

Waypoint waypoint_from_words(const std::vector<std::string>& words) {
  return {0.0, parse_number(words.at(0), "x"), parse_number(words.at(1), "y"),
          parse_number(words.at(2), "z"), parse_number(words.at(3), "yaw_deg") * kRadiansPerDegree};
}

}  // namespace trident::control
