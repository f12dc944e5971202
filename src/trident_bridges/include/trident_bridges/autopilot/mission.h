// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges/autopilot/answer.h"
#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// Commands that a mission may hold; the numbers are MAVLink's MAV_CMD.
namespace mission_command {
constexpr std::uint16_t kWaypoint = 16;           ///< hold [s], radius [m], -, yaw [deg]
constexpr std::uint16_t kLoiterForever = 17;      ///< -, -, -, yaw [deg]
constexpr std::uint16_t kLoiterTurns = 18;        ///< turns, -, radius [m]
constexpr std::uint16_t kLoiterTime = 19;         ///< time [s]
constexpr std::uint16_t kReturn = 20;             ///< to the home position
constexpr std::uint16_t kLand = 21;               ///< there
constexpr std::uint16_t kTakeOff = 22;            ///< to that height
constexpr std::uint16_t kSplineWaypoint = 82;     ///< as a waypoint, on straight lines
constexpr std::uint16_t kDelay = 93;              ///< time [s]
constexpr std::uint16_t kConditionDelay = 112;    ///< time [s]
constexpr std::uint16_t kConditionYaw = 115;      ///< angle [deg], -, -, 1: relative
constexpr std::uint16_t kJump = 177;              ///< index, repetitions (-1: for ever)
constexpr std::uint16_t kChangeSpeed = 178;       ///< -, speed [m/s]
constexpr std::uint16_t kSetHome = 179;           ///< 1: here
constexpr std::uint16_t kSetServo = 183;          ///< counted, without effect
constexpr std::uint16_t kRegionOfInterest = 201;  ///< heading towards a place
constexpr std::uint16_t kEnableFence = 207;       ///< 0 off, 1 on
}  // namespace mission_command

/// One item of a mission, its place already in the world frame.
struct MissionItem {
  std::uint16_t command = mission_command::kWaypoint;   ///< MAV_CMD
  std::array<double, 4> params = {0.0, 0.0, 0.0, 0.0};  ///< param1 to param4; NaN: as it is
  bool has_place = true;                                ///< false: where the vehicle is
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();  ///< place
};

/// Whether a vehicle goes somewhere, or stays, for this command; others are done in passing.
bool is_navigation(std::uint16_t command);

/// Whether the command is for cameras, gimbals, relays and the like, which no vehicle here has:
/// missions may hold it, it is counted and has no effect.
bool is_for_payload(std::uint16_t command);

/// Whether a vehicle can fly this mission: item, field, value and legal range of the first that it
/// cannot, as UNSUPPORTED or DENIED.
Answer check_mission(const std::vector<MissionItem>& items, VehicleClass vehicle);

/// What the current item asks for.
struct MissionOrder {
  /// Which.
  enum class Kind {
    kGoTo,      ///< to `p_m`
    kTakeOff,   ///< to the height of `p_m`, above where the vehicle is
    kLand,      ///< down at `p_m`
    kReturn,    ///< to the home position
    kCircle,    ///< `turns` around `p_m` with `radius_m`
    kStay,      ///< where it is
    kFinished,  ///< no item is left
  };
  Kind kind = Kind::kFinished;                    ///< which
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();  ///< world
  double radius_m = 0.0;                          ///< of a circle; negative: counter-clockwise
  double turns = 0.0;                             ///< of a circle
  bool is_new = false;                            ///< asked for the first time
};

/// What a step of a mission reports.
struct MissionReport {
  int reached = -1;              ///< index of an item that was done in this step
  double speed_m_s = 0.0;        ///< above 0: legs are flown with it from now on
  bool sets_yaw = false;         ///< `yaw` counts
  bool is_yaw_relative = false;  ///< `yaw` is added to the present one
  double yaw = 0.0;              ///< from east [rad]
  bool looks_at = false;         ///< heading towards `look_at_m` from now on
  Eigen::Vector3d look_at_m = Eigen::Vector3d::Zero();  ///< world
  bool sets_home = false;                               ///< home is here from now on
  int fence = -1;                                       ///< 0 off, 1 on, -1 as it is
};

/// Carries a mission out, item by item in their order. Navigation items wait until the vehicle is
/// there and has stayed for as long as asked; all others are done in passing, delays stop it.
class MissionExecutor {
 public:
  /// Replaces the whole mission and begins at its first item; check it before.
  void load(std::vector<MissionItem> items);
  /// Number of items.
  int size() const { return static_cast<int>(items_.size()); }
  /// Index of the current item; size() when it is finished.
  int current() const { return current_; }
  /// All items.
  const std::vector<MissionItem>& items() const { return items_; }
  /// Continues with that item. Denied when no item has this index.
  Answer set_current(int index);
  /// Begins the current item again, as after a pause.
  void resume();
  /// `has_arrived`: the last order is done. Returns what is to be done now; passes items that are
  /// done in passing, at `now` of simulated time.
  MissionOrder step(SimTime now, bool has_arrived, MissionReport& report);

 private:
  enum class Passing { kDone, kWaiting };
  MissionOrder give(MissionOrder order);
  std::optional<MissionOrder> order_of_current(SimTime now, bool has_arrived,
                                               MissionReport& report);
  MissionOrder order_of(const MissionItem& item);
  bool has_to_wait(double duration_s, SimTime now);
  bool is_held(const MissionItem& item, SimTime now, bool has_arrived);
  Passing pass(const MissionItem& item, SimTime now, MissionReport& report);
  void jump(const MissionItem& item);
  void go_to_next();

  std::vector<MissionItem> items_;
  std::vector<int> jumps_;  // how often each jump was taken
  int current_ = 0;
  bool is_new_ = true;
  SimTime held_since_{-1};
};

}  // namespace trident::bridges
