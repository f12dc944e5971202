// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/motion_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trident::nav {
namespace {

/// How many steps between headings an arc turns whose chord is a cell's diagonal.
int steps_of_turn(const ArcMotions& options) {
  const double step = 2.0 * kPi / options.headings;
  const double angle = 2.0 * std::asin(std::min(1.0, std::sqrt(0.5) / options.radius));
  return std::max(1, static_cast<int>(std::ceil(angle / step - 1e-9)));
}

std::vector<Pose2> sample_poses(const Pose2& start, const CurveSegment& segment, double radius,
                                double spacing) {
  const double length = radius * std::abs(segment.length);
  const int count = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  std::vector<Pose2> poses;
  for (int i = 1; i <= count; ++i) {
    Pose2 pose = pose_along(start, segment, radius, length * i / count);
    pose.yaw -= start.yaw;
    poses.push_back(pose);
  }
  return poses;
}

/// The line, and for each number of steps between headings an arc of the chord of the tightest.
class ArcBuilder {
 public:
  explicit ArcBuilder(const ArcMotions& options)
      : options_(options),
        turn_(steps_of_turn(options)),
        step_(2.0 * kPi / options.headings),
        chord_(2.0 * options.radius * std::sin(turn_ * step_ / 2.0)) {}

  void add_from(MotionSet& set, int heading) const {
    for (const int gear : {1, -1}) {
      if (gear < 0 && options_.model == MotionModel::kDubins) break;
      add(set, heading, gear, 0);
      for (int k = options_.interpolates ? 1 : turn_; k <= turn_; ++k) {
        add(set, heading, gear, k);
        add(set, heading, gear, -k);
      }
    }
  }

 private:
  // An arc that turns the heading by k steps.
  void add(MotionSet& set, int heading, int gear, int k) const {
    const double angle = std::abs(k) * step_;
    const double radius = k == 0 ? 1.0 : chord_ / (2.0 * std::sin(angle / 2.0));
    Primitive p;
    p.turn = static_cast<std::int8_t>(k == 0 ? 0 : (k > 0 ? gear : -gear));
    const CurveSegment segment{p.turn, gear * (k == 0 ? chord_ : angle)};
    const Pose2 start{0.0, 0.0, set.heading(static_cast<std::size_t>(heading))};
    const std::vector<Pose2> poses = sample_poses(start, segment, radius, options_.pose_spacing);
    p.reverses = gear < 0;
    p.dx = poses.back().x;
    p.dy = poses.back().y;
    p.length = static_cast<float>(radius * std::abs(segment.length));
    const float gear_factor = gear < 0 ? options_.reversing : 1.0F;
    p.factor = gear_factor * (k == 0 ? 1.0F : options_.turning);
    p.change = k == 0 ? 0.0F : gear_factor * options_.change;
    p.start_heading = static_cast<std::uint16_t>(heading);
    p.end_heading =
        static_cast<std::uint16_t>((heading + k + options_.headings) % options_.headings);
    set.add(p, poses);
  }

  ArcMotions options_;
  int turn_;
  double step_, chord_;
};

}  // namespace

MotionSet::MotionSet(std::vector<double> headings) : headings_(std::move(headings)) {}

void MotionSet::add(Primitive primitive, const std::vector<Pose2>& poses) {
  const auto next = static_cast<std::uint32_t>(primitives_.size());
  while (first_.size() <= primitive.start_heading) first_.push_back(next);
  primitive.first_pose = static_cast<std::uint32_t>(poses_.size());
  primitive.pose_count = static_cast<std::uint32_t>(poses.size());
  poses_.insert(poses_.end(), poses.begin(), poses.end());
  longest_ = std::max(longest_, std::hypot(primitive.dx, primitive.dy));
  primitives_.push_back(primitive);
}

void MotionSet::finish() {
  const auto end = static_cast<std::uint32_t>(primitives_.size());
  while (first_.size() <= headings_.size()) first_.push_back(end);
}

std::size_t MotionSet::nearest_heading(double yaw) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < headings_.size(); ++i) {
    const double known = std::abs(wrap_angle(headings_[best] - yaw));
    if (std::abs(wrap_angle(headings_[i] - yaw)) < known) best = i;
  }
  return best;
}

MotionSet arc_motions(const ArcMotions& options) {
  std::vector<double> headings;
  headings.reserve(static_cast<std::size_t>(options.headings));
  for (int i = 0; i < options.headings; ++i) {
    headings.push_back(wrap_angle(2.0 * kPi * i / options.headings));
  }
  MotionSet set(std::move(headings));
  const ArcBuilder builder(options);
  for (int i = 0; i < options.headings; ++i) builder.add_from(set, i);
  set.finish();
  return set;
}

MotionSet reversed(const MotionSet& motions) {
  std::vector<double> headings;
  for (std::size_t i = 0; i < motions.heading_count(); ++i) headings.push_back(motions.heading(i));
  std::vector<Primitive> sorted = motions.primitives();
  std::stable_sort(sorted.begin(), sorted.end(), [](const Primitive& a, const Primitive& b) {
    return a.end_heading < b.end_heading;
  });
  MotionSet result(std::move(headings));
  for (Primitive p : sorted) {
    const Pose2* poses = motions.poses(p);
    const Pose2& end = poses[p.pose_count - 1];
    std::vector<Pose2> backwards;
    for (std::uint32_t i = p.pose_count - 1; i > 0; --i) {
      const Pose2& pose = poses[i - 1];
      backwards.push_back({pose.x - end.x, pose.y - end.y, pose.yaw - end.yaw});
    }
    backwards.push_back({-end.x, -end.y, -end.yaw});
    p.dx = -p.dx;
    p.dy = -p.dy;
    std::swap(p.start_heading, p.end_heading);
    result.add(p, backwards);
  }
  result.finish();
  return result;
}

}  // namespace trident::nav
