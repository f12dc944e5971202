// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/links/radio_end.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_sim/model.h"

namespace trident::sim {

SE3 RadioEnd::T_world_antenna() const { return link->T_world_link() * T_link_antenna; }

double RadioEnd::gain_towards_dbi(const SE3& T_world_antenna,
                                  const Eigen::Vector3d& direction) const {
  if (pattern == AntennaPattern::kIsotropic) return gain_dbi;
  // Relative to broadside; along the axis what reflections around the robot leave.
  constexpr double kMin_db = -20.0;
  const double cosine = (T_world_antenna.R * Eigen::Vector3d::UnitZ()).dot(direction);
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  const double field = sine > 1e-6 ? std::cos(0.5 * kPi * cosine) / sine : 0.0;
  return gain_dbi + std::max(20.0 * std::log10(std::max(field, 1e-6)), kMin_db);
}

}  // namespace trident::sim
