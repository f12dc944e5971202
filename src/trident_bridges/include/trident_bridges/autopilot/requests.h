// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

namespace trident::bridges {

/// Arms or disarms.
struct ArmRequest {
  bool is_armed = true;    ///< false: disarms
  bool is_forced = false;  ///< without checks, and disarming in the air, too
};
/// Another mode, by the number of the vehicle's flavor.
struct ModeRequest {
  std::uint32_t custom_mode = 0;  ///< as in HEARTBEAT
};
/// Up from where it stands.
struct TakeOffRequest {
  /// Above where it stands [m]; NaN: as the parameters say.
  double height_m = std::numeric_limits<double>::quiet_NaN();
};
/// To a single place.
struct GoToRequest {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();  ///< where
  std::optional<double> yaw;                            ///< heading there, from east [rad]
  double speed_m_s = 0.0;                               ///< above 0: from now on
};
/// Back to the home position.
struct ReturnRequest {};
/// Down where it is.
struct LandRequest {};
/// Speed along legs from now on.
struct SpeedRequest {
  double speed_m_s = 0.0;  ///< above 0
};
/// Heading from now on.
struct YawRequest {
  double yaw = 0.0;          ///< from east, counter-clockwise [rad]
  bool is_relative = false;  ///< added to the present heading
};
/// Heading towards a place, or no longer.
struct LookAtRequest {
  std::optional<Eigen::Vector3d> p_world_m;  ///< none: as the legs have it
};
/// Begins the mission, or continues it.
struct MissionStartRequest {
  int first = -1;  ///< index of an item; -1: the current one
};
/// Chooses the current item.
struct MissionItemRequest {
  int index = 0;  ///< of an item
};
/// Stops where it is, or continues the mission.
struct PauseRequest {
  bool is_paused = true;  ///< false: continues
};
/// Switches the fence.
struct FenceRequest {
  bool is_on = true;  ///< false: off
};
/// Another home position.
struct HomeRequest {
  std::optional<Eigen::Vector3d> p_world_m;  ///< none: here
};
/// The checks before arming, as texts.
struct CheckRequest {};

/// What a ground station or companion computer may ask of an autopilot.
using Request =
    std::variant<ArmRequest, ModeRequest, TakeOffRequest, GoToRequest, ReturnRequest, LandRequest,
                 SpeedRequest, YawRequest, LookAtRequest, MissionStartRequest, MissionItemRequest,
                 PauseRequest, FenceRequest, HomeRequest, CheckRequest>;

}  // namespace trident::bridges
