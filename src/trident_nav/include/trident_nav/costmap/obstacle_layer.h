// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_nav/costmap/beam_layer.h"

namespace trident::nav {

/// Obstacles as cells of the ground: a beam clears all cells that it passes at the height of
/// obstacles.
class ObstacleLayer : public BeamLayer {
 public:
  using Params = BeamLayerParams;

  explicit ObstacleLayer(const LayerSetup& setup);

  void set_params(const Params& params) { set_beam_params(params); }

 private:
  void clear_beams(const Observation& observation, const Reach& reach) override;
  void clear_beam(const BeamGroup& group, const BeamEnd& end, const Reach& reach);
  void mark_ends(const Observation& observation, const Reach& reach, double now_s) override;
};

}  // namespace trident::nav
