// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "homotopy_map.h"
#include "teb_guide.h"
#include "teb_problem.h"

namespace trident::nav {

/// Whether a band's first poses, as many as the parameters ask for, and what is between them are
/// free of contact for the checker's footprint.
bool is_band_free(const TebModel& model, const Situation& situation, const TebBand& band);

/// Keeps bands of several homotopy classes and chooses between them. Rösmann, Hoffmann, Bertram,
/// "Integrated online trajectory planning and optimization in distinctive topologies", Robotics and
/// Autonomous Systems 88 (2017), section 4. Not thread-safe.
class TebPlanner {
 public:
  /// `model` must outlive it.
  TebPlanner(const TebModel& model, UnknownCells unknown) : model_(model), unknown_(unknown) {}

  /// The best band that is free of contact; nothing if all are in contact. `grid`: the situation's
  /// one, with distances. The pointer holds until the next call.
  const TebBand* plan(const Situation& situation, const CostGrid& grid);
  void reset();

  std::size_t bands() const { return candidates_.size(); }
  /// Notes all bands, what they keep away from and what draws them, as the last plan left them.
  void describe(ControlDetails* details) const;

 private:
  struct Candidate {
    TebBand band;
    HSignature signature = 0;
    TebCost cost;
    bool is_present = false;  ///< The one that the last command came from.
    bool is_initial = false;  ///< It passes obstacles as the path does.
    bool is_free = false;
  };

  void keep_bands(const TebGuide& guide);
  void add_band(const TebGuide& guide, const std::vector<Point2>& points, HSignature signature);
  bool is_known(HSignature signature) const;
  void untangle(const TebGuide& guide, TebBand* band) const;
  void sign_bands(const HomotopyMap& map);
  void explore(const TebGuide& guide, const HomotopyMap& map, HSignature initial);
  void add_other_classes(const TebGuide& guide, const HomotopyMap& map);
  void optimize(const Situation& situation, const TebGuide& guide, const FootprintDistance& shape,
                const TebObstacles& obstacles);
  void drop_doubles(const HomotopyMap& map);
  void drop_detours();
  double weighed_cost(const Candidate& candidate, double now_s) const;
  Candidate* cheapest_free(double now_s);
  Candidate* best(double now_s);
  TebRegion area_about(const TebGuide& guide) const;
  TebObstacles obstacles_about(const Situation& situation, const TebGuide& guide) const;

  const TebModel& model_;
  UnknownCells unknown_;
  std::vector<Candidate> candidates_;
  Pose2 goal_;
  double switched_s_ = 0.0;
  /// What the last plan was made with, for pictures.
  struct Surroundings {
    std::vector<Point2> obstacles, via_points;
  };
  Surroundings around_;
};

}  // namespace trident::nav
