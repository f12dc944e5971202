// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/state_archive.h"

namespace trident::sim {

/// What a pack of lithium polymer cells is made of.
struct BatteryParams {
  double capacity_ah = 5.0;      ///< above 0
  int cells = 4;                 ///< in series, 1 or more
  double resistance_ohm = 0.02;  ///< of the whole pack, not negative
};

/// A pack of cells in series: its open-circuit voltage follows the charge, and its resistance takes
/// voltage from it under load (Rint model: H. He, R. Xiong, J. Fan, "Evaluation of Lithium-Ion
/// Battery Equivalent Circuit Models", Energies 4, 2011, section 2.1).
class BatteryCells {
 public:
  /// Full.
  explicit BatteryCells(const BatteryParams& params);

  /// Fills or empties it, 0 to 1.
  void set_charge_share(double share) { charge_share_ = share; }
  /// Draws a power [W] for a time [s]. Beyond what the pack can give it gives that greatest power;
  /// empty, it gives none.
  void draw(double power_w, double time_s);

  double charge_share() const { return charge_share_; }   ///< 0 to 1
  double voltage_v() const { return voltage_v_; }         ///< under the last load
  double current_a() const { return current_a_; }         ///< of the last load
  bool is_empty() const { return charge_share_ <= 0.0; }  ///< nothing is left
  /// Saves or restores what changes.
  void state(StateArchive& archive) { archive(charge_share_, voltage_v_, current_a_); }

  /// Of one cell that rests, at a charge of 0 to 1 [V].
  static double open_circuit_v(double charge_share);

 private:
  BatteryParams params_;
  double charge_share_ = 1.0;
  double voltage_v_ = 0.0;
  double current_a_ = 0.0;
};

}  // namespace trident::sim
