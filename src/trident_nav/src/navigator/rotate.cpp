// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "recoveries.h"
#include "trident_base/angle.h"
#include "trident_base/config_types.h"
#include "trident_nav/control/braking_guard.h"
#include "trident_nav/control/motion.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav {
namespace {

/// Names of rotate_recovery.
struct RotateParams {
  double sim_granularity = 0.017;
  double frequency = 20.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("sim_granularity", sim_granularity, Range{1e-4, 1.0},
             "between the headings at which the footprint is checked [rad]");
    ar.field("frequency", frequency, Range::positive(),
             "accepted: commands come at controller_frequency [Hz]");
  }
};

/// A turn on the spot, so that sensors see everything around: a whole one, or to and fro as far as
/// the footprint is free.
class Rotate : public Recovery {
 public:
  Rotate(const RecoverySetup& setup, const RotateParams& params)
      : setup_(setup),
        params_(params),
        checker_(grown_footprint(setup.footprint, guard_padding_m(setup.footprint))) {}

  void start() override {
    targets_.clear();
    has_begun_ = false;
    turned_ = 0.0;
  }

  RecoveryStep step(const RecoverySituation& situation) override {
    const RobotState& state = situation.state;
    const bool can_turn = setup_.limits.wz_max > 0.0 && setup_.limits.min_turning_radius <= 0.0;
    if (!can_turn) return {{}, true, "The robot cannot turn on the spot."};
    if (!has_begun_ && !begin(situation)) {
      return {{}, true, "The footprint has no room to turn on the spot."};
    }
    turned_ += wrap_angle(state.pose.yaw - last_yaw_);
    last_yaw_ = state.pose.yaw;
    note_progress(situation.now_s);
    drop_finished(situation);
    const TwistWindow window = reachable_window(setup_.limits, state.twist, setup_.period_s);
    if (targets_.empty()) return ended(window);
    return {window.clamp({0.0, 0.0, rate(targets_.front() - turned_)}), false, ""};
  }

 private:
  static constexpr double kReached = 0.03;  // [rad]
  static constexpr double kMargin = 0.05;   // [rad]
  static constexpr double kPatience_s = 3.0;

  /// Plans the turn. False: no turn is free.
  bool begin(const RecoverySituation& situation) {
    has_begun_ = true;
    last_yaw_ = situation.state.pose.yaw;
    progress_s_ = situation.now_s;
    const double left = free_turn(situation, 2.0 * kPi), right = free_turn(situation, -2.0 * kPi);
    if (std::max(left, right) >= 2.0 * kPi) {
      targets_ = {left >= right ? 2.0 * kPi : -2.0 * kPi};
      return true;
    }
    constexpr double kWorthwhile = 0.1;
    if (left + right < kWorthwhile) return false;
    // Where the footprint is not free all around, a little is left at the ends.
    const double to_left = std::max(left - kMargin, 0.0),
                 to_right = -std::max(right - kMargin, 0.0);
    targets_ = left <= right ? std::vector<double>{to_left, to_right}
                             : std::vector<double>{to_right, to_left};
    return true;
  }

  /// How far the footprint can turn toward an angle from where it is [rad].
  double free_turn(const RecoverySituation& situation, double angle) const {
    Pose2 pose = situation.state.pose;
    const double start = pose.yaw;
    const int steps = static_cast<int>(std::ceil(std::fabs(angle) / params_.sim_granularity));
    for (int i = 1; i <= steps; ++i) {
      pose.yaw = start + angle * i / steps;
      if (!checker_.is_free(situation.local, pose)) return std::fabs(angle) * (i - 1) / steps;
    }
    return std::fabs(angle);
  }

  void note_progress(double now_s) {
    if (std::fabs(turned_ - progress_) < kReached) return;
    progress_ = turned_;
    progress_s_ = now_s;
  }

  /// Drops a target that is reached, that an obstacle has come before, or that the robot gets no
  /// nearer to.
  void drop_finished(const RecoverySituation& situation) {
    if (targets_.empty()) return;
    const double left = targets_.front() - turned_, speed = std::fabs(situation.state.twist.wz);
    const double ahead = speed * speed / (2.0 * setup_.limits.alpha_max) +
                         2.0 * speed * setup_.period_s + 2.0 * params_.sim_granularity;
    const double looked = std::min(ahead, std::fabs(left));
    const bool is_blocked = free_turn(situation, std::copysign(looked, left)) < looked;
    const bool is_stuck = situation.now_s - progress_s_ > kPatience_s;
    if (std::fabs(left) > kReached && !is_blocked && !is_stuck) return;
    targets_.erase(targets_.begin());
    progress_s_ = situation.now_s;
  }

  double rate(double angle) const {
    const double fastest =
        stopping_speed(std::fabs(angle), setup_.limits.alpha_max, setup_.period_s);
    return std::copysign(std::min(fastest, setup_.limits.wz_max), angle);
  }

  RecoveryStep ended(const TwistWindow& window) const {
    char text[80];
    std::snprintf(text, sizeof text, "The robot has turned on the spot, last to %.2f rad.",
                  turned_);
    return {window.clamp({}), true, text};
  }

  RecoverySetup setup_;
  RotateParams params_;
  FootprintChecker checker_;
  std::vector<double> targets_;  // angles from the heading at the start [rad]
  bool has_begun_ = false;
  double turned_ = 0.0, last_yaw_ = 0.0;
  double progress_ = 0.0, progress_s_ = 0.0;
};

}  // namespace

void add_rotate(RecoveryRegistry& registry) {
  registry.add(
      "rotate_recovery/RotateRecovery",
      [](const RecoverySetup& setup, const ConfigNode& parameters, const std::string& source) {
        return std::make_unique<Rotate>(setup, load_config_node<RotateParams>(parameters, source));
      });
}

}  // namespace trident::nav
