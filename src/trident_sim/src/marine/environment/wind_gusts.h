// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"

namespace trident::sim {

/// Dryden turbulence at low altitude (MIL-F-8785C): what it is made of follows from the mean wind
/// at 20 ft and the altitude unless it is given.
struct DrydenParams {
  double wind_at_6m = 0.0;
  double altitude = 10.0;
  double airspeed = 0.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("wind_at_6m", wind_at_6m, Range{0.0, 60.0}, "mean wind 20 ft above ground [m/s]");
    ar.field("altitude", altitude, Range{3.0, 300.0}, "above ground [m]");
    ar.field("airspeed", airspeed, Range{0.0, 100.0},
             "at which the turbulence goes by; 0: the mean wind's [m/s]");
  }

  Eigen::Vector3d intensities() const;  ///< sigma_u, sigma_v, sigma_w [m/s]
  Eigen::Vector3d lengths() const;      ///< L_u, L_v, L_w [m]
};

/// Gusts along, across and above the mean wind, one sample per step. Every filter is discretised
/// exactly and starts in its stationary state, so that intensity and spectrum do not depend on the
/// step.
class DrydenGusts {
 public:
  /// Throws Error when dt_s is not > 0.
  DrydenGusts(const DrydenParams& params, double dt_s, std::uint64_t seed, const std::string& name);

  void step();
  void reset();
  /// (along the mean wind, to its left, up) [m/s].
  Eigen::Vector3d gust() const;

  /// Takes over another's samples so far; its own intensities and lengths stay.
  void continue_from(const DrydenGusts& other);

  template <class Archive>
  void state(Archive& archive) {
    archive(index_, along_, left_, up_);
  }

 private:
  /// sigma (1 + sqrt(3) s / a) / (1 + s / a)^2 in its own state space, scaled to unit variance.
  struct SecondOrder {
    Eigen::Matrix2d transition, noise_root, start_root;
    Eigen::RowVector2d output;
    double sigma = 0.0;
  };
  static SecondOrder second_order(double sigma, double rate_1_s, double dt_s);
  double normal(std::uint32_t channel) const { return stream_.normal(index_, channel); }

  RandomStream stream_;
  double along_decay_, along_sigma_;
  SecondOrder left_filter_, up_filter_;
  std::uint64_t index_ = 0;
  double along_ = 0.0;
  Eigen::Vector2d left_ = Eigen::Vector2d::Zero(), up_ = Eigen::Vector2d::Zero();
};

/// Of FirstOrderGusts.
struct FirstOrderGustParams {
  double deviation = 0.0;      ///< standard deviation [m/s]
  double time_constant = 2.0;  ///< [s]
};

/// White noise behind a lag (Gauss-Markov), whose spectrum falls off as 1 / (1 + (omega tau)^2):
/// the gusts of VRX' wind. Discretised exactly and stationary from the start, as DrydenGusts.
class FirstOrderGusts {
 public:
  /// Throws Error when dt_s or the time constant is not > 0.
  FirstOrderGusts(const FirstOrderGustParams& params, double dt_s, std::uint64_t seed,
                  const std::string& name);

  void step();
  void reset();
  double gust() const { return deviation_ * value_; }  ///< [m/s]
  void continue_from(const FirstOrderGusts& other);

  template <class Archive>
  void state(Archive& archive) {
    archive(index_, value_);
  }

 private:
  RandomStream stream_;
  double deviation_, decay_;
  std::uint64_t index_ = 0;
  double value_ = 0.0;  ///< of unit variance
};

}  // namespace trident::sim
