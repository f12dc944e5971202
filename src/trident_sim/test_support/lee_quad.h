// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "models.h"
#include "scratch_folder.h"

namespace trident::sim {

/// Parameter files of a Lee controller for make_quad(), and the plugin that reads them.
class LeeQuad {
 public:
  static constexpr double kPositionGain = 4.0;

  explicit LeeQuad(double controller_mass_kg, const QuadOptions& options = {});
  /// make_quad() with the controller at its end.
  ModelSpec model() const;

  QuadOptions options;

 private:
  ScratchFolder folder_;
  std::string files_;
};

}  // namespace trident::sim
