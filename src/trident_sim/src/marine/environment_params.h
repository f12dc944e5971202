// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "current.h"
#include "trident_base/yaml_config.h"
#include "wave_params.h"

namespace trident {

/// What surrounds vessels, as config/environments/*.yaml says it.
struct EnvironmentParams {
  double water_level = 0.0;
  WaveParams waves;
  CurrentParams current;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("water_level", water_level, Range{-1000.0, 9000.0},
             "of the still water above z = 0, e.g. the tide's [m]");
    ar.field("waves", waves, "of the sea");
    ar.field("current", current, "the water's flow but for waves");
  }
};

}  // namespace trident
