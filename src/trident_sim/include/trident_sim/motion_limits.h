// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/se3.h"

namespace trident::sim {

/// What no body of a world does. One that does is taken for one whose state grows without bound,
/// and ODE ends the program where a rotation overflows: nobody may ask for it.
inline constexpr double kFarthestBodyM = 1e7;    ///< from the origin, per coordinate
inline constexpr double kFastestMS = 1e5;        ///< per component
inline constexpr double kFastestTurnRadS = 1e4;  ///< per component
/// Of a force [N], a torque [N m], or an effort of a joint.
inline constexpr double kStrongest = 1e15;

/// False for NaN, too.
inline bool is_within(const Eigen::Vector3d& v, double most) {
  return (v.array().abs() <= most).all();
}
/// Where a body can be put; its quaternion need not be of length 1, but of a length.
inline bool is_place(const SE3& T_world_body) {
  const double length = T_world_body.R.norm();
  return is_within(T_world_body.p, kFarthestBodyM) && length >= 1e-6 && length <= 1e6;
}
/// What a body can move with: no component is NaN, beyond kFastestMS or beyond kFastestTurnRadS.
inline bool is_motion(const Eigen::Vector3d& v_world, const Eigen::Vector3d& w_world) {
  return is_within(v_world, kFastestMS) && is_within(w_world, kFastestTurnRadS);
}

}  // namespace trident::sim
