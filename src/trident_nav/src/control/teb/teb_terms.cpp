// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "teb_terms.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

// Slopes by the variables of two poses: x, y, yaw, dt of the first, then of the second.
constexpr std::size_t kX0 = 0, kY0 = 1, kYaw0 = 2, kDt0 = 3, kX1 = 4, kY1 = 5, kYaw1 = 6;

// What a chord lacks of its arc: the factor half / sin(half), and its slope by the half angle.
struct ArcFactor {
  double value = 1.0, slope = 0.0;
};

ArcFactor arc_factor(double half) {
  if (std::fabs(half) < 1e-3) return {1.0 + half * half / 6.0, half / 3.0};
  const double sine = std::sin(half);
  return {half / sine, (sine - half * std::cos(half)) / (sine * sine)};
}

void lengthen_to_arc(double turn, TebQuantity<2>* along) {
  const ArcFactor factor = arc_factor(0.5 * turn);
  for (double& slope : along->slopes) slope *= factor.value;
  along->slopes[kYaw0] -= 0.5 * factor.slope * along->value;
  along->slopes[kYaw1] += 0.5 * factor.slope * along->value;
  along->value *= factor.value;
}

}  // namespace

SegmentMotion segment_motion(const TebNode& from, const TebNode& to, ArcLength length) {
  const double dx = to.pose.x - from.pose.x;
  const double dy = to.pose.y - from.pose.y;
  const double turn = wrap_angle(to.pose.yaw - from.pose.yaw);
  const double heading = from.pose.yaw + 0.5 * turn;
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  SegmentMotion motion;
  motion.along = {c * dx + s * dy, {-c, -s, 0.0, 0.0, c, s, 0.0, 0.0}};
  motion.across = {c * dy - s * dx, {s, -c, 0.0, 0.0, -s, c, 0.0, 0.0}};
  motion.turn = {turn, {0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0}};
  // Both headings turn the axes by half of their change.
  motion.along.slopes[kYaw0] = motion.along.slopes[kYaw1] = 0.5 * motion.across.value;
  motion.across.slopes[kYaw0] = motion.across.slopes[kYaw1] = -0.5 * motion.along.value;
  if (length == ArcLength::kExact) lengthen_to_arc(turn, &motion.along);
  return motion;
}

TebQuantity<2> rate(const TebQuantity<2>& path, double dt_s) {
  const double inverse = 1.0 / dt_s;
  TebQuantity<2> result;
  result.value = path.value * inverse;
  for (std::size_t i = 0; i < result.slopes.size(); ++i)
    result.slopes[i] = path.slopes[i] * inverse;
  result.slopes[kDt0] -= result.value * inverse;
  return result;
}

TebQuantity<3> acceleration(const TebQuantity<2>& first, const TebQuantity<2>& second, double dt0_s,
                            double dt1_s) {
  const double inverse = 2.0 / (dt0_s + dt1_s);
  TebQuantity<3> result;
  result.value = (second.value - first.value) * inverse;
  for (std::size_t i = 0; i < first.slopes.size(); ++i) {
    result.slopes[i] -= first.slopes[i] * inverse;
    result.slopes[kTebVariables + i] += second.slopes[i] * inverse;
  }
  const double by_duration = 0.5 * result.value * inverse;
  result.slopes[kDt0] -= by_duration;
  result.slopes[kTebVariables + kDt0] -= by_duration;
  return result;
}

TebQuantity<2> end_acceleration(const TebQuantity<2>& segment, double known, double dt_s,
                                double sign) {
  TebQuantity<2> change = segment;
  change.value = sign * (segment.value - known);
  for (double& slope : change.slopes) slope *= sign;
  return rate(change, dt_s);
}

TebQuantity<2> turning_excess(const SegmentMotion& motion, double radius_m) {
  TebQuantity<2> result;
  result.value = radius_m * std::fabs(motion.turn.value) - std::fabs(motion.along.value);
  const double turn_sign = std::copysign(radius_m, motion.turn.value);
  const double along_sign = std::copysign(1.0, motion.along.value);
  for (std::size_t i = 0; i < result.slopes.size(); ++i) {
    result.slopes[i] = turn_sign * motion.turn.slopes[i] - along_sign * motion.along.slopes[i];
  }
  return result;
}

TebQuantity<2> length(const SegmentMotion& motion) {
  const double along = motion.along.value;
  const double across = motion.across.value;
  TebQuantity<2> result;
  result.value = std::hypot(along, across);
  // Poses that are equal have no direction in which their distance grows.
  const double inverse = 1.0 / std::max(result.value, 1e-9);
  for (std::size_t i = 0; i < result.slopes.size(); ++i) {
    result.slopes[i] =
        (along * motion.along.slopes[i] + across * motion.across.slopes[i]) * inverse;
  }
  return result;
}

TebQuantity<1> clearance(const FootprintDistance& footprint, const Pose2& pose, double cosine,
                         double sine, const Point2& center, double radius_m) {
  const double dx = center.x - pose.x;
  const double dy = center.y - pose.y;
  const Point2 in_base{cosine * dx + sine * dy, cosine * dy - sine * dx};
  const SignedDistance found = footprint.to(in_base);
  const double nx = found.direction.x;
  const double ny = found.direction.y;
  // The pose moves against the point, and a turn moves the point about the base.
  return {found.distance_m - radius_m,
          {-(cosine * nx - sine * ny), -(sine * nx + cosine * ny), nx * in_base.y - ny * in_base.x,
           0.0}};
}

TebQuantity<1> clearance(const Pose2& pose, double cosine, double sine, const TebPlane& plane) {
  const double x = cosine * plane.corner.x - sine * plane.corner.y;
  const double y = sine * plane.corner.x + cosine * plane.corner.y;
  const Point2& u = plane.direction;
  return {plane.reach_m - u.x * (pose.x + x) - u.y * (pose.y + y),
          {-u.x, -u.y, u.x * y - u.y * x, 0.0}};
}

TebQuantity<1> separation(const Pose2& pose, const Point2& point) {
  const double dx = pose.x - point.x;
  const double dy = pose.y - point.y;
  const double d = std::hypot(dx, dy);
  const double inverse = 1.0 / std::max(d, 1e-9);
  return {d, {dx * inverse, dy * inverse, 0.0, 0.0}};
}

}  // namespace trident::nav
