// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "wind_gusts.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

constexpr double kFootPerMeter = 1.0 / 0.3048;
/// Air that stands still still passes: no turbulence then, but a filter wants a rate.
constexpr double kLowestAirspeed = 0.1;
constexpr std::uint32_t kFirstOrderChannel = 10;

/// The denominator of MIL-F-8785C's low-altitude formulas.
double height_term(double altitude_m) { return 0.177 + 0.000823 * altitude_m * kFootPerMeter; }

/// Transition over t of x' = A x, A = [-a, 0; a, -a]: two first-order lags in a row.
Eigen::Matrix2d two_lags(double a, double t) {
  Eigen::Matrix2d F;
  F << 1.0, 0.0, a * t, 1.0;
  return std::exp(-a * t) * F;
}

/// Covariance after t of two lags of rate a in a row, from rest, driven by white noise of which the
/// first lag has unit variance in the end: integral of F(s) B B' F(s)' ds, B = (sqrt(2 a), 0).
Eigen::Matrix2d driven(double a, double t) {
  const double x = 2.0 * a * t, e = std::exp(-x);
  // Integrals of 2 a exp(-2 a s) (a s)^n ds over [0, t] for n = 0, 1, 2.
  const double i0 = 1.0 - e;
  const double i1 = 0.5 * (1.0 - e * (1.0 + x));
  const double i2 = 0.25 * (2.0 - e * (2.0 + 2.0 * x + x * x));
  Eigen::Matrix2d Q;
  Q << i0, i1, i1, i2;
  return Q;
}

Eigen::Matrix2d root(const Eigen::Matrix2d& covariance) {
  Eigen::Matrix2d L = Eigen::Matrix2d::Zero();
  L(0, 0) = std::sqrt(covariance(0, 0));
  L(1, 0) = L(0, 0) > 0.0 ? covariance(1, 0) / L(0, 0) : 0.0;
  L(1, 1) = std::sqrt(std::max(0.0, covariance(1, 1) - L(1, 0) * L(1, 0)));
  return L;
}

}  // namespace

Eigen::Vector3d DrydenParams::intensities() const {
  // MIL-F-8785C below 1,000 ft: sigma_w = 0.1 W20,
  // with the wind W20 at 20 ft, and sigma_u = sigma_v.
  const double up = 0.1 * wind_at_6m;
  const double level = up / std::pow(height_term(altitude), 0.4);
  return {level, level, up};
}

Eigen::Vector3d DrydenParams::lengths() const {
  // Scale lengths L_w = h, L_u = L_v = h / (0.177 + 0.000823 h)^1.2 with h in feet.
  const double level = altitude / std::pow(height_term(altitude), 1.2);
  return {level, level, altitude};
}

DrydenGusts::SecondOrder DrydenGusts::second_order(double sigma, double rate_1_s, double dt_s) {
  SecondOrder filter;
  filter.transition = two_lags(rate_1_s, dt_s);
  filter.noise_root = root(driven(rate_1_s, dt_s));
  Eigen::Matrix2d stationary;
  stationary << 1.0, 0.5, 0.5, 0.5;
  filter.start_root = root(stationary);
  // (1 + sqrt(3) s/a) / (1 + s/a)^2 = sqrt(3) / (1 + s/a) + (1 - sqrt(3)) / (1 + s/a)^2
  filter.output << std::sqrt(3.0), 1.0 - std::sqrt(3.0);
  filter.sigma =
      sigma / std::sqrt((filter.output * stationary * filter.output.transpose()).value());
  return filter;
}

DrydenGusts::DrydenGusts(const DrydenParams& params, double dt_s, std::uint64_t seed,
                         const std::string& name)
    : stream_(seed, name) {
  if (!(dt_s > 0.0)) throw Error("gusts: dt = " + number_text(dt_s) + " s, legal is > 0");
  const double airspeed =
      std::max(kLowestAirspeed, params.airspeed > 0.0 ? params.airspeed : params.wind_at_6m);
  const Eigen::Vector3d sigma = params.intensities();
  const Eigen::Vector3d rate = airspeed * params.lengths().cwiseInverse();
  along_decay_ = std::exp(-rate[0] * dt_s);
  along_sigma_ = sigma[0];
  left_filter_ = second_order(sigma[1], rate[1], dt_s);
  up_filter_ = second_order(sigma[2], rate[2], dt_s);
  reset();
}

void DrydenGusts::reset() {
  index_ = 0;
  along_ = normal(0);
  left_ = left_filter_.start_root * Eigen::Vector2d(normal(1), normal(2));
  up_ = up_filter_.start_root * Eigen::Vector2d(normal(3), normal(4));
}

void DrydenGusts::step() {
  ++index_;
  // Exact discretizations, so that intensity and correlation do not depend on the step.
  along_ = along_decay_ * along_ + std::sqrt(1.0 - along_decay_ * along_decay_) * normal(0);
  left_ = left_filter_.transition * left_ +
          left_filter_.noise_root * Eigen::Vector2d(normal(1), normal(2));
  up_ = up_filter_.transition * up_ + up_filter_.noise_root * Eigen::Vector2d(normal(3), normal(4));
}

void DrydenGusts::continue_from(const DrydenGusts& other) {
  index_ = other.index_;
  along_ = other.along_;
  left_ = other.left_;
  up_ = other.up_;
}

Eigen::Vector3d DrydenGusts::gust() const {
  return {along_sigma_ * along_, left_filter_.sigma * (left_filter_.output * left_).value(),
          up_filter_.sigma * (up_filter_.output * up_).value()};
}

FirstOrderGusts::FirstOrderGusts(const FirstOrderGustParams& params, double dt_s,
                                 std::uint64_t seed, const std::string& name)
    : stream_(seed, name), deviation_(params.deviation) {
  if (!(dt_s > 0.0)) throw Error("gusts: dt = " + number_text(dt_s) + " s, legal is > 0");
  if (!(params.time_constant > 0.0)) {
    throw Error("gusts: time constant = " + number_text(params.time_constant) + " s, legal is > 0");
  }
  decay_ = std::exp(-dt_s / params.time_constant);
  reset();
}

void FirstOrderGusts::reset() {
  index_ = 0;
  value_ = stream_.normal(index_, kFirstOrderChannel);
}

void FirstOrderGusts::step() {
  ++index_;
  value_ = decay_ * value_ +
           std::sqrt(1.0 - decay_ * decay_) * stream_.normal(index_, kFirstOrderChannel);
}

void FirstOrderGusts::continue_from(const FirstOrderGusts& other) {
  index_ = other.index_;
  value_ = other.value_;
}

}  // namespace trident::sim
