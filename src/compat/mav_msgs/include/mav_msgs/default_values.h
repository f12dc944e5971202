// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mav_msgs/common.h>

namespace mav_msgs {

const double kZurichLatitude = 0.8267;  ///< [rad]
const double kZurichHeight = 405.94;    ///< [m]
/// Gravity where a vehicle is assumed to fly unless configured otherwise [m/s^2].
const double kGravity = MagnitudeOfGravity(kZurichHeight, kZurichLatitude);

}  // namespace mav_msgs
