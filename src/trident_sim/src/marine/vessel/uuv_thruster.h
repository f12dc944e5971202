// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident::sim {

/// How a thruster of uuv_simulator follows its input u. With the state s:
///   ZeroOrder   s = u
///   FirstOrder  time_constant s_dot = u - s
///   Yoerger     s_dot = beta u - alpha s|s|
///   Bessa       Jmsp s_dot = Kt u / Rm - Kv1 s - Kv2 s|s|
enum class UuvDynamics { kZeroOrder, kFirstOrder, kYoerger, kBessa };
constexpr auto enum_names(UuvDynamics) {
  return std::array{EnumName{UuvDynamics::kZeroOrder, "ZeroOrder"},
                    EnumName{UuvDynamics::kFirstOrder, "FirstOrder"},
                    EnumName{UuvDynamics::kYoerger, "Yoerger"},
                    EnumName{UuvDynamics::kBessa, "Bessa"}};
}

/// What its state becomes [N]:
///   Basic         rotorConstant s|s|
///   Bessa         rotorConstantL (s|s| - deltaL) below deltaL, rotorConstantR (s|s| - deltaR)
///                 above deltaR, nothing between
///   LinearInterp  linear between points, constant beyond them
enum class UuvConversion { kBasic, kBessa, kLinearInterp };
constexpr auto enum_names(UuvConversion) {
  return std::array{EnumName{UuvConversion::kBasic, "Basic"},
                    EnumName{UuvConversion::kBessa, "Bessa"},
                    EnumName{UuvConversion::kLinearInterp, "LinearInterp"}};
}

struct UuvThrusterParams {
  UuvDynamics dynamics = UuvDynamics::kZeroOrder;
  double time_constant_s = 0.0;
  double alpha = 0.0, beta = 0.0;
  double Jmsp = 0.0, Kv1 = 0.0, Kv2 = 0.0, Kt = 0.0, Rm = 0.0;
  UuvConversion conversion = UuvConversion::kBasic;
  double rotor_constant = 0.0;
  double rotor_constant_left = 0.0, rotor_constant_right = 0.0;
  double delta_left = 0.0, delta_right = 0.0;
  std::vector<double> inputs, outputs;
};

/// A thruster of uuv_simulator. Drag of its dynamics acts on the state at the end of the step,
/// which is stable at any step; upstream's explicit step is not.
class UuvThruster {
 public:
  explicit UuvThruster(UuvThrusterParams params) : params_(std::move(params)) {}

  void step(double input, double dt_s);
  double state_value() const { return state_; }
  /// [N] at a state, before limits and efficiencies.
  double thrust_at(double state) const;
  void reset() { state_ = 0.0; }

  template <class Archive>
  void state(Archive& archive) {
    archive(state_);
  }

 private:
  UuvThrusterParams params_;
  double state_ = 0.0;
};

}  // namespace trident::sim
