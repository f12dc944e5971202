// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_control/control_types.h"
#include "trident_control/drift_observer.h"
#include "trident_control/heading_autopilot.h"
#include "trident_control/line_of_sight.h"
#include "trident_control/station_keeping.h"
#include "trident_control/surge_speed_controller.h"
#include "trident_control/thrust_allocation.h"
#include "trident_control/wave_filter.h"

namespace trident::control {

/// A command to a vessel. Angles from x towards y of the odometry's frame.
struct VesselCommand {
  /// Which of the fields below count, in which meaning.
  enum class Kind {
    kVelocity,  ///< speed [m/s] and rate [rad/s]
    kHeading,   ///< angle [rad]
    kCourse,    ///< over ground, angle [rad]
    kSpeed,     ///< speed [m/s] of heading, course and path
    kPath,      ///< waypoints [m]
    kStation,   ///< waypoints[0] [m], and the heading `angle` [rad] of vessels that can choose
    kStop       ///< thrusters stand until the next command
  };
  Kind kind = Kind::kVelocity;                  ///< see Kind
  double speed = 0.0, rate = 0.0, angle = 0.0;  ///< [m/s], [rad/s], [rad]
  std::vector<Eigen::Vector2d> waypoints;       ///< in the odometry's frame [m]

  /// To the bit, so that a command that is sent again is recognized.
  bool operator==(const VesselCommand& other) const;
};

/// What became of a command: texts are empty when nothing is wrong.
struct CommandVerdict {
  std::string refused;  ///< why; nothing has changed
  std::string clamped;  ///< what was cut to which limit
};

/// What the newest command asks for; kIdle: nothing, or that the thrusters stand.
enum class VesselMode { kIdle, kVelocity, kHeading, kCourse, kPath, kStation };
/// "idle", "velocity", "heading", "course", "path" or "station".
const char* name_of(VesselMode mode);

/// A vessel's controllers behind one another: the newest command decides the mode; that sets
/// heading and speed, or a force; autopilot and speed controller make a force of them, and the
/// allocation commands of that. Time is the stamps of the states.
class VesselController {
 public:
  /// Throws Error: a pose is to be held that the thrusters cannot hold.
  VesselController(const VesselModel& model, const VesselControlParams& params);

  /// A command that acts at once (stamp 0, or one of another clock, more than 60 s ahead), or with
  /// the first state at or after its stamp. Waiting ones are replaced by later ones of their stamp;
  /// a stamped one that comes again, as latched topics and patient senders do, changes nothing.
  CommandVerdict push(SimTime stamp, const VesselCommand& command);
  /// The surge speed through the water, as a speed log measures it at `stamp` [m/s].
  void set_log(SimTime stamp, double u_water);
  /// Works out commands() for a state. Zeros until something is commanded. When time runs back
  /// everything is forgotten. On anything but ok nothing has changed.
  ControlStatus update(SimTime stamp, const OdometryState& odometry);
  /// Idle, as constructed. Commands without a stamp that still wait are kept: they came after the
  /// last state, and belong to the new time.
  void reset();

  /// In the order of topics(); see ThrustAllocation.
  Span<const double> commands() const { return allocation_.commands(); }
  /// See ThrustAllocation::topics().
  const std::vector<std::string>& topics() const { return allocation_.topics(); }

  VesselMode mode() const { return mode_; }  ///< after the last update()
  /// Distance to the left of the path [m]; 0 without one.
  double cross_track_m() const { return mode_ == VesselMode::kPath ? path_.cross_track_m() : 0.0; }
  /// What was asked of the thrusters last, and what they give.
  const PlanarForce& asked() const { return forces_.asked; }
  const PlanarForce& given() const { return forces_.given; }  ///< see asked()

 private:
  struct Pending {
    SimTime stamp;
    VesselCommand command;

    bool operator==(const Pending& other) const {
      return stamp == other.stamp && command == other.command;
    }
  };
  /// Heading and speed, or surge and sway force and heading.
  struct Setpoint {
    double heading = 0.0, speed = 0.0;
    std::optional<double> rate;            // in place of the heading
    std::optional<Eigen::Vector2d> force;  // in place of the speed
    bool over_ground = false;              // the speed is, whatever the parameters say
  };

  /// What the last commands ask for.
  struct Commanded {
    SimTime at;
    bool has_timeout = false;
    double cruise = 0.0;  ///< speed of heading, course and path [m/s]
    double speed = 0.0, rate = 0.0, angle = 0.0;
    double crab = 0.0;  ///< by which the bow leads a course against the drift [rad]
  };
  /// Keeping a place, with its controllers.
  struct StationKeeping {
    PlaceHold hold;
    WeatherVane vane;
    WaveFilter filter;
    bool holds_pose;
    bool is_near = false;
    Eigen::Vector2d p_world = Eigen::Vector2d::Zero();
  };
  /// Speed through the water, as it was measured last.
  struct SpeedLog {
    std::optional<double> speed;
    SimTime stamp;
  };
  /// Of the last state: what the controllers asked for, and what the actuators give of it.
  struct Forces {
    PlanarForce asked = PlanarForce::Zero(), given = PlanarForce::Zero();
  };

  void apply_due(SimTime stamp, const VesselState& state);
  void apply(SimTime stamp, const VesselCommand& command, const VesselState& state);
  void enter(VesselMode mode, const VesselState& state);
  void keep_station(const Eigen::Vector2d& place, double heading, const VesselState& state);
  Setpoint setpoint(SimTime stamp, const VesselState& state, double dt_s);
  Setpoint velocity_setpoint(SimTime stamp) const;
  double steered_towards(double course, double speed, const VesselState& state) const;
  Setpoint path_setpoint(SimTime stamp, const VesselState& state, double dt_s);
  Setpoint station_setpoint(const VesselState& state, double dt_s);
  double course_heading(const VesselState& state, double dt_s);
  double slowed(double heading, const VesselState& state) const;
  bool has_log(SimTime stamp) const;
  double speed_through_water(SimTime stamp, const VesselState& state) const;
  std::optional<double> measured_speed(SimTime stamp, const VesselState& state) const;
  void actuate(const Setpoint& setpoint, SimTime stamp, const VesselState& state, double dt_s);

  VesselControlParams params_;
  HeadingAutopilot autopilot_;
  SurgeSpeedController speed_controller_;
  LineOfSight path_;
  DriftObserver drift_;
  ThrustAllocation allocation_;

  std::deque<Pending> pending_;
  std::optional<Pending> last_stamped_;  // of the commands that have acted
  std::optional<SimTime> last_stamp_;
  VesselMode mode_ = VesselMode::kIdle;
  bool is_speed_held_ = false;
  Commanded commanded_;
  StationKeeping station_;
  SpeedLog log_;
  Forces forces_;
};

}  // namespace trident::control
