// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "teb_guide.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::nav {
namespace {

double direction(const Point2& a, const Point2& b) { return std::atan2(b.y - a.y, b.x - a.x); }

// Points of a line with a least distance between them; the first and the last stay.
std::vector<Point2> thinned(const std::vector<Point2>& points, double step_m) {
  std::vector<Point2> kept{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point2& p = points[i];
    if (distance(kept.back().x, kept.back().y, p.x, p.y) < step_m) continue;
    if (distance(points.back().x, points.back().y, p.x, p.y) < 0.5 * step_m) break;
    kept.push_back(p);
  }
  if (points.size() > 1) kept.push_back(points.back());
  return kept;
}

double goal_yaw(const TebModel& model, const Situation& situation, double travel_yaw) {
  const LocalPath& path = situation.path;
  // A robot that turns on the spot arrives straight and turns there.
  const bool arrives_turned = !model.can_turn_on_spot || model.is_holonomic;
  if (path.reaches_goal && arrives_turned) return situation.goal.yaw;
  if (path.has_headings && (path.is_reverse || arrives_turned)) return path.headings.back();
  return travel_yaw;
}

void add_via_points(const TebModel& model, const std::vector<Point2>& points,
                    const std::vector<Point2>* given, std::vector<Point2>* via_points) {
  const double separation_m = model.params.global_plan_viapoint_sep;
  if (separation_m <= 0.0) {
    if (given != nullptr) *via_points = *given;
    return;
  }
  Point2 last = points.front();
  for (const Point2& p : points) {
    if (distance(last.x, last.y, p.x, p.y) < separation_m) continue;
    via_points->push_back(p);
    last = p;
  }
}

// Headings between that of the robot and another one, on the spot.
void append_turn(const Pose2& start, double yaw, double max_turn, Path* poses) {
  const double angle = wrap_angle(yaw - start.yaw);
  const int count = static_cast<int>(std::fabs(angle) / max_turn);
  for (int i = 1; i <= count; ++i) {
    poses->push_back({start.x, start.y, wrap_angle(start.yaw + angle * i / (count + 1))});
  }
}

// Whether a band that is not known yet begins backwards.
bool begins_backward(const TebModel& model, const TebGuide& guide, double direction) {
  const double ahead = wrap_angle(direction - guide.start.yaw);
  const bool may_begin_backward =
      model.params.allow_init_with_backwards_motion && model.limits.vx_min < 0.0;
  return guide.task.is_reverse || (may_begin_backward && std::fabs(ahead) > 0.5 * kPi);
}

}  // namespace

double first_direction(const std::vector<Point2>& points, double length_m) {
  const Point2& start = points.front();
  for (const Point2& p : points) {
    if (distance(start.x, start.y, p.x, p.y) >= length_m) return direction(start, p);
  }
  return direction(start, points.back());
}

TebGuide make_guide(const TebModel& model, const Situation& situation) {
  const LocalPath& path = situation.path;
  TebGuide guide;
  guide.start = situation.state.pose;
  guide.points.push_back({guide.start.x, guide.start.y});
  const std::size_t first = path.poses.size() > 1 ? 1 : 0;
  for (std::size_t i = first; i < path.poses.size(); ++i) {
    guide.points.push_back({path.poses[i].x, path.poses[i].y});
  }
  const std::size_t count = guide.points.size();
  const double travel = direction(guide.points[count - 2], guide.points[count - 1]);
  guide.task.is_reverse = path.is_reverse;
  const double facing = path.is_reverse ? wrap_angle(travel + kPi) : travel;
  guide.goal = {guide.points.back().x, guide.points.back().y, goal_yaw(model, situation, facing)};
  guide.task.start_twist = situation.state.twist;
  guide.task.stops_at_end = path.ends_at_cusp || (path.reaches_goal && !model.params.free_goal_vel);
  add_via_points(model, guide.points, situation.via_points, &guide.task.via_points);
  return guide;
}

TebBand guess_band(const TebModel& model, const TebGuide& guide,
                   const std::vector<Point2>& points) {
  const double step_m =
      std::min(0.8 * model.spacing.max_step_m, model.pace.v * model.spacing.dt_ref_s);
  const std::vector<Point2> line = thinned(points, step_m);
  const bool is_backward = begins_backward(model, guide, first_direction(line, step_m));
  Path poses{guide.start};
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const double travel = direction(line[i - 1], line[i + 1]);
    poses.push_back({line[i].x, line[i].y, is_backward ? wrap_angle(travel + kPi) : travel});
  }
  poses.push_back(guide.goal);
  Path turned{guide.start};
  if (model.can_turn_on_spot) {
    append_turn(guide.start, poses[1].yaw, model.spacing.max_turn, &turned);
  }
  turned.insert(turned.end(), poses.begin() + 1, poses.end());
  return band_through(turned, model.pace);
}

}  // namespace trident::nav
