// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "environment_params.h"
#include "trident_sim/sea.h"
#include "wave_field.h"

namespace trident {

/// The sea that an environment describes.
class Environment : public Sea {
 public:
  /// Throws Error for values that are not legal.
  Environment(const EnvironmentParams& params, std::uint64_t seed)
      : waves_(params.waves, seed), current_(params.current) {
    waves_.set_level(params.water_level);
  }

  const Water& water() const override { return waves_; }
  const Current& current() const override { return current_; }
  const WaveField& waves() const { return waves_; }

 private:
  WaveField waves_;
  Current current_;
};

}  // namespace trident
