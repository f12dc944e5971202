// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "trident_trajectories/distance_map.h"
#include "trident_trajectories/prediction.h"

namespace trident::trajectories {

/// What a robot can do. A UAV moves in space; the others in a plane of constant z, along their
/// heading, so that x and y are flat outputs: heading is the direction of motion, turn rate and
/// curvature follow from the first two derivatives (Fliess et al., 1995).
enum class Kind {
  kUav,        ///< multirotor
  kUnicycle,   ///< differential drive, which may turn on the spot before it starts
  kAckermann,  ///< with a smallest turning radius
  kVessel,     ///< with drag and current: through the water along its heading
};

/// Of "uav", "ugv" (a unicycle), "unicycle", "ackermann", "usv" and "vessel". Throws Error listing
/// them for another name.
Kind kind_of_name(const std::string& name);
/// "uav", "unicycle", "ackermann" or "vessel".
const char* name_of(Kind kind);

/// A limit that does not bind.
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Hard limits of one robot; kUnlimited leaves one out.
struct Limits {
  double max_velocity = 2.0;               ///< > 0 [m/s]
  double max_acceleration = kUnlimited;    ///< > 0 [m/s^2]
  double max_jerk = kUnlimited;            ///< > 0 [m/s^3]
  double max_turn_rate = kUnlimited;       ///< > 0, of robots in the plane [rad/s]
  double min_turning_radius = 0.0;         ///< >= 0, of kAckermann [m]
  double collision_radius = 0.5;           ///< > 0 [m]
  double max_thrust = kUnlimited;          ///< > 0, ahead, of kVessel [N]
  double max_reverse_thrust = kUnlimited;  ///< > 0, astern, of kVessel [N]
};

/// Surge of a vessel: mass and drag, in water that moves.
struct SurgeModel {
  double mass = 0.0;               ///< with added mass; 0: thrust is not limited [kg]
  double linear_damping = 0.0;     ///< >= 0 [N s/m]
  double quadratic_damping = 0.0;  ///< >= 0 [N s^2/m^2]
  Eigen::Vector2d current = Eigen::Vector2d::Zero();  ///< of the water over ground [m/s]
};

/// Where a robot is to end: at `state`, to which the deck's position, or the place that is chosen,
/// is added.
struct Goal {
  MotionState state;  ///< of planar robots without z
  int place = -1;     ///< >= 0: a place is chosen for all who name it; `state.p` is relative to it
  std::shared_ptr<const Prediction> deck;  ///< what is landed on; may be null
};

/// One that is planned.
struct Robot {
  std::string name;          ///< unique, not empty
  Kind kind = Kind::kUav;    ///< what it can do
  Limits limits;             ///< hard
  SurgeModel surge;          ///< of a vessel
  MotionState start;         ///< at time 0
  Goal goal;                 ///< at the end of its duration
  double drag = 0.05;        ///< >= 0, per mass; counts for the cost of energy alone [1/m]
  std::size_t duration = 0;  ///< index into Problem::durations; who shares one arrives together
};

/// How long trajectories take.
struct Duration {
  double value = 5.0;    ///< > 0; the first guess where it is free [s]
  double min = 0.0;      ///< of a free one; 0: a tenth of `value` [s]
  double max = 0.0;      ///< of a free one; 0: ten times `value` [s]
  bool is_free = false;  ///< whether it is chosen between `min` and `max`
};

/// Weights of what is minimized, summed over the robots. Each integral is divided by its value on
/// the undisturbed path, so that weights are shares.
struct CostWeights {
  double jerk = 1.0;    ///< of the integral of squared jerk
  double length = 0.0;  ///< of the path
  double time = 0.0;    ///< of the durations
  double energy = 0.0;  ///< of the integral of |a|^2 * 1 s + drag |v|^3
};

/// "jerk", "length", "time", "energy" or "mixed" (equal parts). Throws Error listing them.
CostWeights cost_of_name(const std::string& name);

/// Two robots are near each other under path: at `fraction` of the duration that they share,
/// |p_first - p_second - offset| <= tolerance. To gather at the end is Goal::place.
struct Rendezvous {
  std::size_t first = 0, second = 0;                 ///< robots
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< [m]
  double tolerance = 0.1;                            ///< > 0 [m]
  double fraction = 0.5;                             ///< 0 ... 1
};

/// Robot `later` arrives at least `gap` after `earlier`.
struct ArrivalOrder {
  std::size_t earlier = 0, later = 0;  ///< robots of different durations
  double gap = 0.0;                    ///< >= 0 [s]
};

/// Something that moves without being planned.
struct MovingObstacle {
  std::string name;       ///< for messages
  Prediction prediction;  ///< of its center
  double radius = 0.5;    ///< > 0 [m]
  double height_factor =
      kUnlimited;  ///< >= 1; dz is divided by it: 1 a sphere, kUnlimited a cylinder
};

/// Two robots that need not keep apart (one lands on the other).
struct AllowedContact {
  std::size_t first = 0, second = 0;  ///< robots
};

/// A team's task. Robots i and j keep apart at equal times if
/// dx^2 + dy^2 + (dz / k)^2 >= (r_i + r_j)^2, where k is `downwash` between UAVs, else 1. At its
/// end a robot stays, or moves on with its deck, until the last one has arrived.
struct Problem {
  std::vector<Robot> robots;                       ///< at least one
  std::vector<Duration> durations = {Duration{}};  ///< at least one
  std::vector<Eigen::Vector3d> places;           ///< places that are chosen; the first guesses [m]
  CostWeights cost;                              ///< what is minimized
  double downwash = 1.0;                         ///< >= 1
  double min_height = -kUnlimited;               ///< that UAVs keep above [m]
  std::shared_ptr<const DistanceMap> obstacles;  ///< that stand still; may be null
  std::vector<MovingObstacle> moving;            ///< that do not
  std::vector<Rendezvous> rendezvous;            ///< who is near whom
  std::vector<ArrivalOrder> order;               ///< who arrives after whom
  std::vector<AllowedContact> contacts;          ///< who may touch
};

/// Throws Error with one message that names robot or list element, field, value and legal range:
/// nothing to plan, a name twice, NaN, a limit that is not positive, a start inside an obstacle, or
/// an index that does not exist.
void validate(const Problem& problem);

}  // namespace trident::trajectories
