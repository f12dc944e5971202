// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "current.h"
#include "seabed.h"
#include "tide.h"
#include "trident_base/yaml_config.h"
#include "wave_params.h"
#include "wind.h"

namespace trident::sim {

/// What surrounds vessels and aircraft, as config/environments/*.yaml says it.
struct EnvironmentParams {
  double water_level = 0.0;
  TideParams tide;
  WaveParams waves;
  CurrentParams current;
  WindParams wind;
  BathymetryParams bathymetry;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("water_level", water_level, Range{-1000.0, 9000.0},
             "of the still water above z = 0 [m]");
    ar.field("tide", tide, "how the level moves");
    ar.field("waves", waves, "of the sea");
    ar.field("current", current, "the water's flow but for waves");
    ar.field("wind", wind, "the air's flow");
    ar.field("bathymetry", bathymetry, "the ground below the water");
  }
};

}  // namespace trident::sim
