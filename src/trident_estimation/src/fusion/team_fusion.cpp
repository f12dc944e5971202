// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/fusion/team_fusion.h"

#include <algorithm>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::estimation {

TeamFusion::TeamFusion(std::vector<RobotStart> robots, const TeamFusionOptions& options)
    : robots_(std::move(robots)), options_(options), T_map_base_(robots_.size()) {
  std::vector<RobotMotion> motions;
  for (const RobotStart& robot : robots_) motions.push_back(robot.motion);
  model_ = std::make_shared<TeamModel>(std::move(motions));
  options_.trust.validate();
  if (!(options_.gate > 0.0 && options_.gate < 1.0)) {
    throw Error("fusion: gate is " + number_text(options_.gate) + ", legal is in (0, 1)");
  }
  if (options_.keep < SimTime{} || options_.start_patience < SimTime{}) {
    throw Error("fusion: keep and start_patience are at least 0 s");
  }
}

void TeamFusion::note_pose(std::size_t robot, SimTime stamp, const SE3& T_map_base) {
  if (history_) return;
  T_map_base_[robot] = T_map_base;
  if (!first_heard_) first_heard_ = stamp;
  const bool are_all_heard = std::all_of(T_map_base_.begin(), T_map_base_.end(),
                                         [](const auto& pose) { return pose.has_value(); });
  if (are_all_heard || stamp - *first_heard_ >= options_.start_patience) start(stamp);
}

void TeamFusion::start(SimTime stamp) {
  std::vector<RobotStart> robots = robots_;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (T_map_base_[i]) robots[i].T_map_base = *T_map_base_[i];
  }
  const TeamStart begin = team_start(robots);
  history_.emplace(Filter(options_.kind, model_, stamp, begin.state, begin.covariance),
                   options_.keep, options_.trust);
}

void TeamFusion::add(Measurement measurement) {
  if (!history_) return;
  measurement.gate = gate_of(options_.gate, measurement.z.size());
  pending_.push_back(std::move(measurement));
}

std::vector<Outcome> TeamFusion::update() {
  if (!history_ || pending_.empty()) return {};
  return history_->add_all(std::exchange(pending_, {}));
}

void TeamFusion::restart() {
  history_.reset();
  first_heard_.reset();
  pending_.clear();
  std::fill(T_map_base_.begin(), T_map_base_.end(), std::nullopt);
}

std::optional<Filter> TeamFusion::at(SimTime stamp) const {
  return history_ ? history_->at(stamp) : std::nullopt;
}

SimTime TeamFusion::newest() const { return history_ ? history_->newest().stamp() : SimTime{}; }

std::map<std::string, SourceReport> TeamFusion::reports() const {
  return history_ ? history_->reports() : std::map<std::string, SourceReport>{};
}

}  // namespace trident::estimation
