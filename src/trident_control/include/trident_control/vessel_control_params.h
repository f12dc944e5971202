// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "trident_base/yaml_config.h"

namespace trident::control {

/// Gains follow from the vessel's mass and damping and from these rates.
struct HeadingParams {
  double natural_frequency = 1.0;    ///< [rad/s]
  double damping_ratio = 1.0;        ///< of the closed loop
  double integral_time = 20.0;       ///< [s]
  double reference_frequency = 1.0;  ///< [rad/s]
  double max_rate = 0.4;             ///< [rad/s]
  double max_acceleration = 0.3;     ///< [rad/s^2]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("natural_frequency", natural_frequency, Range{0.0, 10.0, true},
             "of the closed loop [rad/s]");
    ar.field("damping_ratio", damping_ratio, Range{0.1, 5.0}, "of the closed loop");
    ar.field("integral_time", integral_time, Range::non_negative(), "0: no integral [s]");
    ar.field("reference_frequency", reference_frequency, Range{0.0, 10.0, true},
             "of the reference model that leads to a new heading [rad/s]");
    ar.field("max_rate", max_rate, Range{0.0, 3.0, true}, "of turn [rad/s]");
    ar.field("max_acceleration", max_acceleration, Range{0.0, 10.0, true}, "[rad/s^2]");
  }
};

/// What the surge speed is held against.
enum class SpeedReference { kOverGround, kThroughWater };
/// Names of the references in YAML.
constexpr auto enum_names(SpeedReference) {
  return std::array{EnumName{SpeedReference::kOverGround, "over_ground"},
                    EnumName{SpeedReference::kThroughWater, "through_water"}};
}

/// Of the surge speed controller.
struct SpeedParams {
  /// What the surge speed is measured against; kThroughWater takes a speed log.
  SpeedReference reference = SpeedReference::kOverGround;
  double cruise = 1.0;            ///< [m/s]
  double max = 2.0;               ///< [m/s]
  double max_reverse = 0.5;       ///< [m/s]
  double time_constant = 2.0;     ///< [s]
  double integral_time = 10.0;    ///< [s]
  double max_acceleration = 0.3;  ///< [m/s^2]
  double log_timeout = 1.0;       ///< [s]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("reference", reference,
             "through_water needs a speed log; without one only the vessel's drag determines the "
             "thrust");
    ar.field("cruise", cruise, Range{0.0, 30.0, true}, "until another is commanded [m/s]");
    ar.field("max", max, Range{0.0, 30.0, true}, "higher ones are cut [m/s]");
    ar.field("max_reverse", max_reverse, Range{0.0, 30.0}, "the same astern, positive [m/s]");
    ar.field("time_constant", time_constant, Range::positive(), "of the closed loop [s]");
    ar.field("integral_time", integral_time, Range::non_negative(), "0: no integral [s]");
    ar.field("max_acceleration", max_acceleration, Range::positive(), "[m/s^2]");
    ar.field("log_timeout", log_timeout, Range::positive(), "a log older than that is lost [s]");
  }
  /// Throws Error naming field, value and what is legal.
  void validate() const;
};

/// Of steering a course over ground, for which the heading leads by the crab angle.
struct CourseParams {
  double crab_time_constant = 5.0;  ///< [s]
  double min_speed = 0.3;           ///< [m/s]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("crab_time_constant", crab_time_constant, Range::positive(),
             "over which the angle between heading and course is averaged [s]");
    ar.field("min_speed", min_speed, Range::positive(),
             "over ground, below which course is heading [m/s]");
  }
};

/// What follows the last waypoint.
enum class PathEnd { kStop, kKeepStation };
/// Names of the ends in YAML.
constexpr auto enum_names(PathEnd) {
  return std::array{EnumName{PathEnd::kStop, "stop"},
                    EnumName{PathEnd::kKeepStation, "keep_station"}};
}

/// Of line-of-sight guidance along waypoints; see LineOfSight for the law.
struct GuidanceParams {
  double lookahead = 10.0;           ///< [m]
  double integral_gain = 1.0;        ///< [1/s]
  double max_crab_angle = 1.0;       ///< [rad]
  double drift_time_constant = 5.0;  ///< [s]
  /// By how much the bow leads the course through the water into a turn; 0: not at all.
  double course_gain = 1.0;
  double acceptance_radius = 5.0;          ///< [m]
  double slowest_turn = 0.3;               ///< in [0, 1]
  PathEnd at_end = PathEnd::kKeepStation;  ///< after the last waypoint

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("lookahead", lookahead, Range::positive(), "along the line [m]");
    ar.field("integral_gain", integral_gain, Range::non_negative(),
             "sigma [1/s]; 0: neither drift nor integral count");
    ar.field("max_crab_angle", max_crab_angle, Range{0.0, 1.5, true},
             "that drift and integral may come to [rad]");
    ar.field("drift_time_constant", drift_time_constant, Range::positive(),
             "over which the drift across the bow is averaged [s]");
    ar.field("course_gain", course_gain, Range{0.0, 3.0},
             "by which the bow leads the course through the water into a turn; 0: no lead");
    ar.field("acceptance_radius", acceptance_radius, Range::positive(),
             "of a waypoint's circle [m]");
    ar.field("slowest_turn", slowest_turn, Range{0.0, 1.0},
             "part of the speed that is kept when the bow points elsewhere");
    ar.field("at_end", at_end, "of the path");
  }
};

/// kAutomatic: kPose where thrusters push sideways without being turned first, else kWeatherVane.
enum class StationBehavior { kAutomatic, kPose, kWeatherVane };
/// Names of the behaviors in YAML.
constexpr auto enum_names(StationBehavior) {
  return std::array{EnumName{StationBehavior::kAutomatic, "automatic"},
                    EnumName{StationBehavior::kPose, "pose"},
                    EnumName{StationBehavior::kWeatherVane, "weather_vane"}};
}

/// Of keeping a station; see PlaceHold and WeatherVane for the laws.
struct StationParams {
  /// Whether place and heading are held, or the place alone.
  StationBehavior behavior = StationBehavior::kAutomatic;
  double natural_frequency = 0.3;  ///< [rad/s]
  double damping_ratio = 0.9;      ///< of the closed loop
  double integral_time = 30.0;     ///< [s]
  double max_speed = 0.5;          ///< [m/s]
  double approach_radius = 10.0;   ///< [m]
  double wave_frequency = 0.0;     ///< [rad/s]
  double suspension = 5.0;         ///< [m]
  double suspension_rate = 0.05;   ///< [1/s]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field(
        "behaviour", behavior,
        "pose: holds place and heading; weather_vane: the place, its heading is the weather's");
    ar.field("natural_frequency", natural_frequency, Range{0.0, 10.0, true},
             "of the closed loop [rad/s]");
    ar.field("damping_ratio", damping_ratio, Range{0.1, 5.0}, "of the closed loop");
    ar.field("integral_time", integral_time, Range::non_negative(), "0: no integral [s]");
    ar.field("max_speed", max_speed, Range::positive(), "towards the station [m/s]");
    ar.field("approach_radius", approach_radius, Range::positive(),
             "from farther away the vessel goes there bow first [m]");
    ar.field("wave_frequency", wave_frequency, Range::non_negative(),
             "motion about it is left to the waves; 0: none is [rad/s]");
    ar.field("suspension", suspension, Range::positive(),
             "weather_vane: distance of the point that the vessel hangs on [m]");
    ar.field("suspension_rate", suspension_rate, Range{0.0, 1.0, true},
             "at which that point is moved to bring the vessel to its station [1/s]");
  }
};

/// Of velocity commands (cmd_vel).
struct VelocityParams {
  double timeout = 0.5;  ///< [s]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("timeout", timeout, Range::non_negative(),
             "after which a vessel without a new cmd_vel is stopped; 0: never [s]");
  }
};

/// What counts when the thrusters cannot give everything.
struct AllocationParams {
  double surge_weight = 1.0;  ///< of a forward force that is not given
  double sway_weight = 1.0;   ///< of a sideways force that is not given
  double yaw_weight = 100.0;  ///< of a moment that is not given

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("surge_weight", surge_weight, Range{1e-3, 1e3}, "of a force that is not given");
    ar.field("sway_weight", sway_weight, Range{1e-3, 1e3}, "the same");
    ar.field("yaw_weight", yaw_weight, Range{1e-3, 1e3}, "of the moment");
  }
};

/// A config/controllers/*.yaml.
struct VesselControlParams {
  HeadingParams heading;        ///< of the autopilot and its reference model
  SpeedParams speed;            ///< of the surge speed controller
  CourseParams course;          ///< how a course over ground becomes a heading
  GuidanceParams guidance;      ///< along waypoints by line of sight
  StationParams station;        ///< of station keeping, by pose or as a weather vane
  VelocityParams cmd_vel;       ///< when a vessel without new commands stops
  AllocationParams allocation;  ///< of forces to thrusters and rudders

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("heading", heading, "autopilot");
    ar.field("speed", speed, "surge speed");
    ar.field("course", course, "over ground");
    ar.field("guidance", guidance, "along waypoints by line of sight");
    ar.field("station", station, "keeping");
    ar.field("cmd_vel", cmd_vel, "surge speed and rate of turn");
    ar.field("allocation", allocation, "of forces to thrusters and rudders");
  }
};

/// Throws ConfigError naming file, line, key, value and what is legal.
VesselControlParams load_vessel_control(const std::string& path);

}  // namespace trident::control
