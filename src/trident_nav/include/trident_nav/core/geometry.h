// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

namespace trident::nav {

/// A point of the plane in the frame of a costmap [m].
struct Point2 {
  double x = 0.0;
  double y = 0.0;
};

/// A pose of the robot's base in the frame of a costmap [m, rad].
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
};

/// A velocity of the robot's base in its own axes: x forward, y to the left, about z [m/s, rad/s].
struct Twist2 {
  double vx = 0.0;
  double vy = 0.0;
  double wz = 0.0;
};

/// A path or a trajectory's poses in order, each in the frame of the costmap.
using Path = std::vector<Pose2>;

/// The angle that is equal to `angle` but in (-pi, pi] [rad].
inline double wrap_angle(double angle) {
  constexpr double kPi = 3.14159265358979323846;
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

inline double distance(double x0, double y0, double x1, double y1) {
  return std::hypot(x1 - x0, y1 - y0);
}

/// The point that has the coordinates `p` in the axes of `frame`, in those of the costmap.
inline Point2 transform(const Pose2& frame, const Point2& p) {
  const double c = std::cos(frame.yaw);
  const double s = std::sin(frame.yaw);
  return {frame.x + c * p.x - s * p.y, frame.y + s * p.x + c * p.y};
}

}  // namespace trident::nav
