// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "recoveries.h"
#include "trident_base/config_types.h"

namespace trident::nav {
namespace {

/// Names and defaults of move_slow_and_clear.
struct MoveSlowParams {
  double clearing_distance = 0.5;
  double limited_trans_speed = 0.25;
  double limited_rot_speed = 0.45;
  double limited_distance = 0.3;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("clearing_distance", clearing_distance, Range::non_negative(),
             "how far around the robot obstacles are forgotten [m]");
    ar.field("limited_trans_speed", limited_trans_speed, Range::positive(),
             "the fastest that the robot drives meanwhile [m/s]");
    ar.field("limited_rot_speed", limited_rot_speed, Range::positive(),
             "the fastest that it turns meanwhile [rad/s]");
    ar.field("limited_distance", limited_distance, Range::non_negative(),
             "how far it gets before it may be fast again [m]");
    ar.field("max_trans_param_name", max_trans_param_name, "accepted: no parameter is changed");
    ar.field("max_rot_param_name", max_rot_param_name, "accepted: no parameter is changed");
  }

 private:
  std::string max_trans_param_name = "max_trans_vel";
  std::string max_rot_param_name = "max_rot_vel";
};

/// Lets the costmaps forget what is close to the robot, and has it drive slowly from there. What
/// its sensors still see comes back at once.
class MoveSlow : public Recovery {
 public:
  explicit MoveSlow(const MoveSlowParams& params) : params_(params) {}

  RecoveryStep step(const RecoverySituation& situation) override {
    const double side_m = 2.0 * params_.clearing_distance;
    situation.world.forget({side_m, Layer::Side::kInside, AffectedMaps::kBoth, {}});
    char note[120];
    std::snprintf(note, sizeof note,
                  "What was sensed within %.2f m of the robot was forgotten; it drives slowly.",
                  params_.clearing_distance);
    RecoveryStep result{{}, true, note};
    result.slow =
        SlowDrive{params_.limited_trans_speed, params_.limited_rot_speed, params_.limited_distance};
    return result;
  }

 private:
  MoveSlowParams params_;
};

}  // namespace

void add_move_slow(RecoveryRegistry& registry) {
  registry.add(
      "move_slow_and_clear/MoveSlowAndClear",
      [](const RecoverySetup&, const ConfigNode& parameters, const std::string& source) {
        return std::make_unique<MoveSlow>(load_config_node<MoveSlowParams>(parameters, source));
      });
}

}  // namespace trident::nav
