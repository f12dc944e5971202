// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "trident_base/yaml_config.h"

namespace trident::sim {

/// kVrxPms and kVrxCwr are VRX' few waves: samples of a Pierson-Moskowitz spectrum of its own peak
/// period, and waves of a constant ratio of height to length.
enum class WaveSpectrum { kNone, kRegular, kPiersonMoskowitz, kJonswap, kVrxPms, kVrxCwr };
constexpr auto enum_names(WaveSpectrum) {
  return std::array{EnumName{WaveSpectrum::kNone, "none"},
                    EnumName{WaveSpectrum::kRegular, "regular"},
                    EnumName{WaveSpectrum::kPiersonMoskowitz, "pierson_moskowitz"},
                    EnumName{WaveSpectrum::kJonswap, "jonswap"},
                    EnumName{WaveSpectrum::kVrxPms, "vrx_pms"},
                    EnumName{WaveSpectrum::kVrxCwr, "vrx_cwr"}};
}

enum class WaveModel { kLinear, kGerstner };
constexpr auto enum_names(WaveModel) {
  return std::array{EnumName{WaveModel::kLinear, "linear"},
                    EnumName{WaveModel::kGerstner, "gerstner"}};
}

/// A sea. Which fields count depends on the spectrum.
struct WaveParams {
  WaveSpectrum spectrum = WaveSpectrum::kNone;
  WaveModel model = WaveModel::kLinear;
  double significant_height = 0.3;
  double peak_period = 4.0;
  double peak_enhancement = 3.3;
  int components = 200;
  double spreading = 0.0;
  double direction = 0.0;
  double amplitude = 0.0;
  double period = 5.0;
  double phase = 0.0;
  int number = 3;
  double scale = 1.5;
  double angle = 0.4;
  double gain = 0.1;
  double steepness = 1.0;
  double depth = std::numeric_limits<double>::infinity();
  double shore_depth = 0.0;
  double ramp_time = 0.0;
  double gravity = 9.81;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("spectrum", spectrum, "of the waves");
    ar.field("model", model, "linear: sums of sines; gerstner: sharper crests");
    ar.field("significant_height", significant_height, Range{0.0, 30.0},
             "jonswap, pierson_moskowitz: four standard deviations [m]");
    ar.field("peak_period", peak_period, Range{0.2, 40.0}, "jonswap, pierson_moskowitz [s]");
    ar.field("peak_enhancement", peak_enhancement, Range{1.0, 10.0}, "jonswap: gamma");
    ar.field("components", components, Range{1.0, 5000.0}, "jonswap, pierson_moskowitz: sines");
    ar.field("spreading", spreading, Range{0.0, 200.0},
             "jonswap, pierson_moskowitz: s of cos^2s(angle / 2); 0: long-crested");
    ar.field("direction", direction, Range{-6.3, 6.3}, "waves run to, from x towards y [rad]");
    ar.field("amplitude", amplitude, Range{0.0, 15.0}, "regular, vrx_cwr [m]");
    ar.field("period", period, Range{0.2, 40.0}, "regular, vrx_cwr; vrx_pms: of the peak [s]");
    ar.field("phase", phase, Range{-6.3, 6.3}, "regular, vrx_*: at the origin at time 0 [rad]");
    ar.field("number", number, Range{1.0, 3.0}, "vrx_*: of waves");
    ar.field("scale", scale, Range{1.0, 10.0, true}, "vrx_*: between neighbouring waves");
    ar.field("angle", angle, Range{-3.2, 3.2}, "vrx_*: between neighbouring directions [rad]");
    ar.field("gain", gain, Range::non_negative(), "vrx_pms: factor of all amplitudes");
    ar.field("steepness", steepness, Range{0.0, 1.0}, "gerstner: 1 is a cusp");
    ar.field("depth", depth, Range::positive().or_infinite(),
             "of the water; inf: deep, or a bathymetry's mean [m]");
    ar.field("shore_depth", shore_depth, Range::non_negative(),
             "where the ground is nearer waves fade; 0: twice the significant height [m]");
    ar.field("ramp_time", ramp_time, Range::non_negative(),
             "tau of the growth 1 - exp(-t/tau) [s]");
    ar.field("gravity", gravity, Range::positive(), "[m/s^2]");
  }
  /// Throws Error: a value that is not legal, a regular wave that would break (height > length /
  /// 7).
  void validate() const;
};

}  // namespace trident::sim
