// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vehicles/battery/battery_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trident::sim {
namespace {

/// A resting lithium polymer cell at 0, 5, 10 ... 100 % [V]; the chart that makers of such packs
/// publish.
constexpr std::array<double, 21> kOpenCircuit_v = {3.27, 3.61, 3.69, 3.71, 3.73, 3.75, 3.77,
                                                   3.79, 3.80, 3.82, 3.84, 3.85, 3.87, 3.91,
                                                   3.95, 3.98, 4.02, 4.08, 4.11, 4.15, 4.20};

}  // namespace

BatteryCells::BatteryCells(const BatteryParams& params)
    : params_(params), voltage_v_(params.cells * open_circuit_v(1.0)) {}

double BatteryCells::open_circuit_v(double charge_share) {
  constexpr auto kParts = static_cast<double>(kOpenCircuit_v.size() - 1);
  const double position = std::clamp(charge_share, 0.0, 1.0) * kParts;
  const auto index = std::min(static_cast<std::size_t>(position), kOpenCircuit_v.size() - 2);
  const double part = position - static_cast<double>(index);
  return kOpenCircuit_v[index] + part * (kOpenCircuit_v[index + 1] - kOpenCircuit_v[index]);
}

void BatteryCells::draw(double power_w, double time_s) {
  const double open_v = params_.cells * open_circuit_v(charge_share_);
  const double power = is_empty() ? 0.0 : std::max(power_w, 0.0);
  // V^2 - open V + P R = 0; beyond open^2 / (4 R) the pack gives its greatest power.
  const double root = open_v * open_v - 4.0 * power * params_.resistance_ohm;
  voltage_v_ = 0.5 * (open_v + std::sqrt(std::max(root, 0.0)));
  current_a_ = root >= 0.0 ? power / voltage_v_ : (open_v - voltage_v_) / params_.resistance_ohm;
  const double drawn_ah = current_a_ * time_s / 3600.0;
  charge_share_ = std::max(0.0, charge_share_ - drawn_ah / params_.capacity_ah);
}

}  // namespace trident::sim
