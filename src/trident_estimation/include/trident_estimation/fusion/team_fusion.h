// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_estimation/filter/history.h"
#include "trident_estimation/fusion/team_model.h"

namespace trident::estimation {

/// How a team's measurements are fused.
struct TeamFusionOptions {
  FilterKind kind = FilterKind::kUkf;
  SimTime keep = SimTime::from_seconds(1.0);            ///< how late a measurement may come
  SimTime start_patience = SimTime::from_seconds(2.0);  ///< how long all robots are waited for
  double gate = 0.99;  ///< share of honest measurements that are used, in (0, 1)
  TrustParams trust;
};

/// One belief about all robots of a team. It begins with the first poses of all robots in their
/// maps, or `start_patience` after the first of them with the robots that were heard until then;
/// the others are believed to be where their maps begin. What is added is filtered at update().
class TeamFusion {
 public:
  /// Throws Error for no robots, motions or options out of range.
  TeamFusion(std::vector<RobotStart> robots, const TeamFusionOptions& options);

  /// A robot's pose in its map; nothing but the start needs it.
  void note_pose(std::size_t robot, SimTime stamp, const SE3& T_map_base);
  /// To be filtered at the next update(); dropped before the start. Its gate is set.
  void add(Measurement measurement);
  /// Filters what was added; what became of each.
  std::vector<Outcome> update();
  /// Forgets all, and waits for poses again.
  void restart();

  bool has_started() const { return history_.has_value(); }  ///< whether there is a belief
  /// The belief at a moment; none before the start, and for one that is not kept.
  std::optional<Filter> at(SimTime stamp) const;
  SimTime newest() const;  ///< stamp of the newest measurement; zero before the start
  /// By source; empty before the start.
  std::map<std::string, SourceReport> reports() const;

 private:
  void start(SimTime stamp);

  std::vector<RobotStart> robots_;
  TeamFusionOptions options_;
  std::shared_ptr<const TeamModel> model_;
  std::vector<std::optional<SE3>> T_map_base_;  ///< first poses, by robot
  std::optional<SimTime> first_heard_;
  std::optional<History> history_;
  std::vector<Measurement> pending_;
};

}  // namespace trident::estimation
