// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/lattice_set.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "trident_base/error.h"

namespace trident::nav {
namespace {

/// How many steps between headings a motion turns at most.
constexpr int kMaxTurnSteps = 3;
/// Straight motions are not shorter [cells].
constexpr double kMinStraight = 2.8;

/// The directions of a set as steps between cells' centers, counter-clockwise from +x.
std::vector<Cell> heading_steps(int count) {
  std::vector<Cell> octant{{1, 0}};
  if (count == 32) octant.push_back({3, 1});
  if (count >= 16) octant.push_back({2, 1});
  if (count == 32) octant.push_back({3, 2});
  octant.push_back({1, 1});
  std::vector<Cell> steps(octant);
  for (std::size_t i = octant.size() - 1; i-- > 1;) steps.push_back({octant[i].y, octant[i].x});
  const std::size_t quarter = steps.size();
  for (std::size_t k = quarter; k < 4 * quarter; ++k) {
    const Cell& c = steps[k - quarter];
    steps.push_back({-c.y, c.x});
  }
  return steps;
}

double angle_of(Cell c) {
  const double angle = std::atan2(c.y, c.x);
  return angle < 0.0 ? angle + 2.0 * kPi : angle;
}

/// A straight line and an arc, in either order, between two poses at cells' centers [cells].
struct LineAndArc {
  double straight = 0.0;
  double radius = 0.0;
  double turn = 0.0;  ///< Signed [rad].
  bool line_first = true;

  double arc() const { return radius * std::abs(turn); }
  double length() const { return straight + arc(); }
};

/// From the origin at one heading to a cell at another, by the tangents' intersection.
std::optional<LineAndArc> connect(double from_yaw, double to_yaw, Cell to) {
  const double turn = wrap_angle(to_yaw - from_yaw);
  const double sine = std::sin(turn);
  if (std::abs(sine) < 1e-9) return std::nullopt;
  const double ahead = (to.x * std::sin(to_yaw) - to.y * std::cos(to_yaw)) / sine;
  const double after = (to.y * std::cos(from_yaw) - to.x * std::sin(from_yaw)) / sine;
  const double tangent = std::min(ahead, after);
  if (tangent < 1e-9) return std::nullopt;
  return LineAndArc{std::abs(ahead - after), tangent / std::tan(std::abs(turn) / 2.0), turn,
                    ahead > after};
}

/// Builds a set.
class LatticeBuilder {
 public:
  explicit LatticeBuilder(const LatticeOptions& options)
      : steps_(heading_steps(options.headings)),
        radius_(options.turning_radius_m / options.resolution_m) {
    set_.motion_model = options.motion_model;
    set_.turning_radius_m = options.turning_radius_m;
    set_.resolution_m = options.resolution_m;
    for (const Cell& c : steps_) set_.heading_angles.push_back(angle_of(c));
  }

  LatticeSet build() {
    const int count = static_cast<int>(steps_.size());
    for (int from = 0; from < count; ++from) {
      for (int k = -kMaxTurnSteps; k <= kMaxTurnSteps; ++k) add_step(from, k, count);
      if (set_.motion_model == "omni") {
        add_straight(from, (from + count / 4) % count);
        add_straight(from, (from + 3 * count / 4) % count);
      }
    }
    return std::move(set_);
  }

 private:
  // From a heading to the one that is `k` steps of `count` to the left.
  void add_step(int from, int k, int count) {
    const int to = (from + k + count) % count;
    if (k == 0) {
      add_straight(from, from);
    } else {
      add_turn(from, to);
    }
    if (std::abs(k) == 1 && set_.motion_model != "ackermann") add_rotation(from, to);
  }
  double yaw(int heading) const { return set_.heading_angles[static_cast<std::size_t>(heading)]; }

  // Along `direction` with the heading `from`.
  void add_straight(int from, int direction) {
    const Cell& step = steps_[static_cast<std::size_t>(direction)];
    const double unit = std::hypot(step.x, step.y);
    const int times = std::max(1, static_cast<int>(std::ceil(kMinStraight / unit - 1e-9)));
    const double length = times * unit;
    LatticeTrajectory t;
    t.start_angle_index = t.end_angle_index = from;
    t.length_m = t.straight_length_m = length * set_.resolution_m;
    const int parts = static_cast<int>(std::ceil(length - 1e-9));
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts * times * set_.resolution_m;
      t.poses.push_back({share * step.x, share * step.y, yaw(from)});
    }
    set_.trajectories.push_back(std::move(t));
  }

  // The shortest of the connections that keep the radius.
  void add_turn(int from, int to) {
    std::optional<LineAndArc> best;
    Cell best_end;
    const double turn = std::abs(wrap_angle(yaw(to) - yaw(from)));
    const int reach = static_cast<int>(std::ceil(2.0 * radius_ * std::tan(turn / 2.0))) + 6;
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const auto found = connect(yaw(from), yaw(to), {x, y});
        if (!found || found->radius < radius_ - 1e-9) continue;
        if (best && found->length() >= best->length() - 1e-9) continue;
        best = found;
        best_end = {x, y};
      }
    }
    if (best) add_connection(from, to, *best, best_end);
  }

  void add_connection(int from, int to, const LineAndArc& found, Cell end) {
    const double m = set_.resolution_m;
    LatticeTrajectory t;
    t.start_angle_index = from;
    t.end_angle_index = to;
    t.left_turn = found.turn > 0.0;
    t.radius_m = found.radius * m;
    t.arc_length_m = found.arc() * m;
    t.straight_length_m = found.straight * m;
    t.length_m = t.arc_length_m + t.straight_length_m;
    const CurveSegment line{0, 1.0};
    const CurveSegment arc{found.turn > 0.0 ? 1 : -1, 1.0};
    Pose2 pose{0.0, 0.0, yaw(from)};
    const auto add = [&](const CurveSegment& segment, double length) {
      const int parts = static_cast<int>(std::ceil(length - 1e-9));
      const Pose2 start = pose;
      for (int i = 1; i <= parts; ++i) {
        pose = pose_along(start, segment, found.radius, length * i / parts);
        t.poses.push_back({pose.x * m, pose.y * m, pose.yaw});
      }
    };
    if (found.line_first) add(line, found.straight);
    add(arc, found.arc());
    if (!found.line_first) add(line, found.straight);
    t.poses.back() = {end.x * m, end.y * m, yaw(to)};
    set_.trajectories.push_back(std::move(t));
  }

  void add_rotation(int from, int to) {
    LatticeTrajectory t;
    t.start_angle_index = from;
    t.end_angle_index = to;
    const double turn = wrap_angle(yaw(to) - yaw(from));
    t.left_turn = turn > 0.0;
    constexpr int kParts = 3;
    for (int i = 0; i <= kParts; ++i) t.poses.push_back({0.0, 0.0, yaw(from) + turn * i / kParts});
    set_.trajectories.push_back(std::move(t));
  }

  std::vector<Cell> steps_;
  double radius_;  ///< [cells]
  LatticeSet set_;
};

/// A trajectory's poses as offsets in cells, with others in between.
std::vector<Pose2> dense_poses(const LatticeTrajectory& t, double start_yaw, double resolution,
                               double spacing_m, double reach_m) {
  std::vector<Pose2> poses;
  Pose2 last{0.0, 0.0, start_yaw};
  for (const Pose2& next : t.poses) {
    const double turn = wrap_angle(next.yaw - last.yaw);
    const double length_m = distance(last.x, last.y, next.x, next.y);
    const double sweep_m = length_m > 0.0 ? length_m : std::abs(turn) * reach_m;
    const int parts = static_cast<int>(std::ceil(sweep_m / spacing_m - 1e-9));
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      poses.push_back({(last.x + share * (next.x - last.x)) / resolution,
                       (last.y + share * (next.y - last.y)) / resolution,
                       last.yaw + share * turn - start_yaw});
    }
    last = {next.x, next.y, last.yaw + turn};
  }
  return poses;
}

Primitive primitive_of(const LatticeTrajectory& t, const LatticeCosts& costs, double resolution) {
  Primitive p;
  p.start_heading = static_cast<std::uint16_t>(t.start_angle_index);
  p.end_heading = static_cast<std::uint16_t>(t.end_angle_index);
  p.length = static_cast<float>(t.length_m / resolution);
  if (t.length_m <= 0.0) {
    p.length = 1.0F;
    p.factor = costs.rotation;
  } else if (t.arc_length_m > 0.0) {
    p.turn = t.left_turn ? 1 : -1;
    p.factor = costs.turning;
    p.change = costs.change;
  }
  return p;
}

struct LatticeMotion {
  Primitive primitive;
  std::vector<Pose2> poses;
};

MotionSet sorted_set(const std::vector<double>& headings, std::vector<LatticeMotion>& motions) {
  std::stable_sort(motions.begin(), motions.end(),
                   [](const LatticeMotion& a, const LatticeMotion& b) {
                     return a.primitive.start_heading < b.primitive.start_heading;
                   });
  MotionSet result(headings);
  for (const LatticeMotion& m : motions) result.add(m.primitive, m.poses);
  result.finish();
  return result;
}

/// Adds all motions but turns on the spot, driven backwards.
void add_backwards(const MotionSet& forwards, const LatticeCosts& costs,
                   std::vector<LatticeMotion>& motions) {
  const MotionSet backwards = reversed(forwards);
  for (Primitive p : backwards.primitives()) {
    if (p.dx == 0.0 && p.dy == 0.0) continue;
    const Pose2* poses = backwards.poses(p);
    p.reverses = true;
    p.factor *= costs.reversing;
    motions.push_back({p, {poses, poses + p.pose_count}});
  }
}

/// Throws Error for options that no lattice can be made with.
void validate(const LatticeOptions& options) {
  static const std::set<std::string> kModels{"diff", "ackermann", "omni"};
  static const std::set<int> kHeadings{8, 16, 32};
  if (kModels.count(options.motion_model) == 0) {
    throw Error("motion_model: " + options.motion_model + ", legal: diff, ackermann, omni");
  }
  if (kHeadings.count(options.headings) == 0) {
    throw Error("headings: " + std::to_string(options.headings) + ", legal: 8, 16, 32");
  }
  if (!(options.resolution_m > 0.0)) throw Error("resolution: legal: a number > 0 [m]");
  const double most_m = 500.0 * options.resolution_m;
  if (!(options.turning_radius_m >= options.resolution_m && options.turning_radius_m <= most_m)) {
    throw Error("radius: " + std::to_string(options.turning_radius_m) +
                ", legal: 1 to 500 cells of the resolution [m]");
  }
}

}  // namespace

LatticeSet make_lattice(const LatticeOptions& options) {
  validate(options);
  return LatticeBuilder(options).build();
}

MotionSet lattice_motions(const LatticeSet& set, const LatticeCosts& costs, double spacing_m) {
  std::vector<double> headings;
  headings.reserve(set.heading_angles.size());
  for (const double angle : set.heading_angles) headings.push_back(wrap_angle(angle));
  std::vector<LatticeMotion> motions;
  for (const LatticeTrajectory& t : set.trajectories) {
    const double start_yaw = headings[static_cast<std::size_t>(t.start_angle_index)];
    LatticeMotion motion{
        primitive_of(t, costs, set.resolution_m),
        dense_poses(t, start_yaw, set.resolution_m, spacing_m, set.turning_radius_m)};
    if (motion.poses.empty()) continue;
    motion.primitive.dx = motion.poses.back().x;
    motion.primitive.dy = motion.poses.back().y;
    motions.push_back(std::move(motion));
  }
  MotionSet forwards = sorted_set(headings, motions);
  if (!costs.reverses) return forwards;
  add_backwards(forwards, costs, motions);
  return sorted_set(headings, motions);
}

}  // namespace trident::nav
