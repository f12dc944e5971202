// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "recoveries.h"
#include "trident_base/config_types.h"
#include "trident_nav/control/braking_guard.h"
#include "trident_nav/control/motion.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav {
namespace {

struct RetreatParams {
  double distance = 0.5;
  double patience = 10.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("distance", distance, Range::positive(), "how far back [m]");
    ar.field("patience", patience, Range::positive(), "how long it may take [s]");
  }
};

/// A trail that is followed closely, in whatever direction its poses lie.
///
/// Each command is the arc to a place a little further along that is tangent to the robot's
/// heading: pure pursuit (Coulter, CMU-RI-TR-92-01, 1992), forwards or backwards as that place
/// lies.
class TrailDrive {
 public:
  explicit TrailDrive(const RecoverySetup& setup)
      : setup_(setup),
        checker_(setup.footprint),
        padded_checker_(grown_footprint(setup.footprint, guard_padding_m(setup.footprint))),
        guard_(setup.limits, checker_, padded_checker_, setup.period_s),
        lookahead_m_(0.5 * setup.footprint.inscribed_radius) {}

  void begin(Path path) {
    path_ = std::move(path);
    next_ = 0;
  }
  /// Whether the robot is at the end.
  bool advance(const Pose2& robot) {
    const auto is_near = [&](const Pose2& pose) {
      return distance(pose.x, pose.y, robot.x, robot.y) < lookahead_m_;
    };
    while (next_ < path_.size() && is_near(path_[next_])) ++next_;
    return next_ == path_.size();
  }
  /// The command; nothing if none is free of contact. Before the end.
  std::optional<Twist2> command(const RecoverySituation& situation) const {
    const RobotState& state = situation.state;
    const TwistWindow window = reachable_window(setup_.limits, state.twist, setup_.period_s);
    const Twist2 wanted = arc_to(path_[next_], state.pose);
    for (const Twist2& twist : {wanted, Twist2{wanted.vx, 0.0, 0.0}}) {
      const Twist2 admitted = admissible_twist(setup_.limits, window, twist);
      if (!guard_.first_contact(state, admitted, situation.local, situation.tracks)) {
        return admitted;
      }
    }
    return std::nullopt;
  }

 private:
  Twist2 arc_to(const Pose2& place, const Pose2& robot) const {
    constexpr double kFastest = 0.2;  // [m/s]
    const double dx = place.x - robot.x, dy = place.y - robot.y;
    const double ahead = std::cos(robot.yaw) * dx + std::sin(robot.yaw) * dy;
    const double aside = -std::sin(robot.yaw) * dx + std::cos(robot.yaw) * dy;
    const double speed = ahead < 0.0 ? -std::min(kFastest, -setup_.limits.vx_min)
                                     : std::min(kFastest, setup_.limits.vx_max);
    return {speed, 0.0, speed * 2.0 * aside / (dx * dx + dy * dy)};
  }

  RecoverySetup setup_;
  FootprintChecker checker_, padded_checker_;
  BrakingGuard guard_;
  double lookahead_m_;
  Path path_;
  std::size_t next_ = 0;
};

/// Back along the trail of the robot, where there was room for it. A robot that cannot reverse
/// leaves it to its controller to turn.
class Retreat : public Recovery {
 public:
  Retreat(const RecoverySetup& setup, const RetreatParams& params)
      : params_(params), can_reverse_(setup.limits.vx_min < 0.0), drive_(setup) {}

  void start() override { path_.clear(); }

  RecoveryStep step(const RecoverySituation& situation) override {
    if (path_.empty()) {
      begin(situation);
      if (path_.size() < 2) return {{}, true, "There is no trail to go back along."};
    }
    if (situation.now_s - begun_s_ > params_.patience) {
      return {{}, true, "Retreat along the trail took too long."};
    }
    return can_reverse_ ? drive_back(situation) : turn_back(situation);
  }

 private:
  static constexpr int kMaxFailures = 20;
  static constexpr const char* kDone = "The robot went back along its trail.";

  RecoveryStep drive_back(const RecoverySituation& situation) {
    if (drive_.advance(situation.state.pose)) return {{}, true, kDone};
    const std::optional<Twist2> twist = drive_.command(situation);
    if (twist) return {*twist, false, ""};
    return {{}, ++failures_ > kMaxFailures, "Retreat is blocked."};
  }

  RecoveryStep turn_back(const RecoverySituation& situation) {
    const CommandOutcome outcome =
        situation.controller.command(situation.state, path_, situation.local, situation.tracks);
    if (outcome.goal_reached) return {outcome.twist, true, kDone};
    if (outcome.failure != Failure::kNone && ++failures_ > kMaxFailures) {
      return {outcome.twist, true, "Retreat is blocked. " + outcome.reason};
    }
    return {outcome.twist, false, ""};
  }

  void begin(const RecoverySituation& situation) {
    failures_ = 0;
    begun_s_ = situation.now_s;
    situation.controller.reset();
    path_ = {situation.state.pose};
    double length_m = 0.0;
    for (auto pose = situation.trail.rbegin(); pose != situation.trail.rend(); ++pose) {
      if (length_m >= params_.distance) break;
      length_m += distance(path_.back().x, path_.back().y, pose->x, pose->y);
      path_.push_back(*pose);
    }
    if (length_m <= 0.0) path_.resize(1);
    drive_.begin(path_);
  }

  RetreatParams params_;
  bool can_reverse_;
  TrailDrive drive_;
  Path path_;
  double begun_s_ = 0.0;
  int failures_ = 0;
};

}  // namespace

void add_retreat(RecoveryRegistry& registry) {
  registry.add("trident_nav/Retreat", [](const RecoverySetup& setup, const ConfigNode& parameters,
                                         const std::string& source) {
    return std::make_unique<Retreat>(setup, load_config_node<RetreatParams>(parameters, source));
  });
}

}  // namespace trident::nav
