// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vessel_command_check.h"

#include <algorithm>
#include <cmath>

#include "trident_base/string_util.h"

namespace trident::control {
namespace {

constexpr std::size_t kMaxWaypoints = 10000;
constexpr double kLargest = 1e8;  // [m], [rad]

std::string range_text(double lo, double hi, const char* unit) {
  return "[" + number_text(lo) + ", " + number_text(hi) + "] " + unit;
}

// Refuses what cannot be meant, and cuts what the vessel cannot do to what it can. The first
// refusal stands; cuts add up in one text.
class Check {
 public:
  void finite(const char* what, double value, const char* unit) {
    // The comparison is false for NaN, too.
    if (std::abs(value) <= kLargest || !verdict.refused.empty()) return;
    verdict.refused = std::string(what) + " = " + number_text(value) + " " + unit +
                      ", legal is a number up to " + number_text(kLargest);
  }
  void limit(const char* what, double& value, double lo, double hi, const char* unit) {
    finite(what, value, unit);
    const double cut = std::clamp(value, lo, hi);
    if (!verdict.refused.empty() || cut == value) return;
    verdict.clamped += (verdict.clamped.empty() ? "" : "; ") + std::string(what) + " = " +
                       number_text(value) + " " + unit + " is cut to " + number_text(cut) +
                       ", legal is " + range_text(lo, hi, unit);
    value = cut;
  }
  void waypoints(const std::vector<Eigen::Vector2d>& points) {
    if (points.empty() || points.size() > kMaxWaypoints) {
      verdict.refused = std::to_string(points.size()) + " waypoints, legal is 1 to " +
                        std::to_string(kMaxWaypoints);
    }
    for (std::size_t i = 0; i < points.size() && verdict.refused.empty(); ++i) {
      const std::string name = "waypoint " + std::to_string(i) + ": ";
      finite((name + "x").c_str(), points[i].x(), "m");
      finite((name + "y").c_str(), points[i].y(), "m");
    }
  }

  CommandVerdict verdict;
};

}  // namespace

CommandVerdict check_command(VesselCommand& command, const VesselControlParams& params) {
  using Kind = VesselCommand::Kind;
  Check check;
  const auto speed = [&] {
    check.limit("surge speed", command.speed, -params.speed.max_reverse, params.speed.max, "m/s");
  };
  switch (command.kind) {
    case Kind::kVelocity:
      speed();
      check.limit("yaw rate", command.rate, -params.heading.max_rate, params.heading.max_rate,
                  "rad/s");
      break;
    case Kind::kSpeed:
      speed();
      break;
    case Kind::kHeading:
      check.finite("heading", command.angle, "rad");
      break;
    case Kind::kCourse:
      check.finite("course", command.angle, "rad");
      break;
    case Kind::kPath:
      check.waypoints(command.waypoints);
      break;
    case Kind::kStation:
      check.waypoints(command.waypoints);
      check.finite("heading", command.angle, "rad");
      break;
    case Kind::kStop:
      break;
  }
  return check.verdict;
}

}  // namespace trident::control
