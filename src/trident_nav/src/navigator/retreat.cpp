// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "recoveries.h"
#include "trident_base/config_types.h"

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

/// Back along the trail of the robot, where there was room for it.
class Retreat : public Recovery {
 public:
  explicit Retreat(const RetreatParams& params) : params_(params) {}

  void start() override { path_.clear(); }

  RecoveryStep step(const RecoverySituation& situation) override {
    if (path_.empty()) {
      begin(situation);
      if (path_.size() < 2) return {{}, true, "There is no trail to go back along."};
    }
    if (situation.now_s - begun_s_ > params_.patience) {
      return {{}, true, "Retreat along the trail took too long."};
    }
    const CommandOutcome outcome =
        situation.controller.command(situation.state, path_, situation.local, situation.tracks);
    if (outcome.goal_reached) return {outcome.twist, true, "The robot went back along its trail."};
    if (outcome.failure != Failure::kNone && ++failures_ > kMaxFailures) {
      return {outcome.twist, true, "Retreat is blocked. " + outcome.reason};
    }
    return {outcome.twist, false, ""};
  }

 private:
  static constexpr int kMaxFailures = 20;

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
  }

  RetreatParams params_;
  Path path_;
  double begun_s_ = 0.0;
  int failures_ = 0;
};

}  // namespace

void add_retreat(RecoveryRegistry& registry) {
  registry.add("trident_nav/Retreat", [](const RecoverySetup&, const ConfigNode& parameters,
                                         const std::string& source) {
    return std::make_unique<Retreat>(load_config_node<RetreatParams>(parameters, source));
  });
}

}  // namespace trident::nav
