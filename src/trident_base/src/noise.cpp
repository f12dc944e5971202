// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/noise.h"

#include <cmath>
#include <string>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

/// Channels of an IMU's stream, six for each triad: white noise of x, y, z, then the biases.
constexpr std::uint32_t kAxes = 3;
constexpr std::uint32_t kWhiteChannel = 0;
constexpr std::uint32_t kBiasChannel = kAxes;
constexpr std::uint32_t kGyroscopeChannel = 0;
constexpr std::uint32_t kAccelerometerChannel = 2 * kAxes;

void require(bool is_legal, const char* name, double value, const char* legal) {
  if (is_legal) return;
  throw Error(std::string("noise: ") + name + " = " + number_text(value) + " must be " + legal);
}

void require_non_negative(const char* name, double value) {
  require(std::isfinite(value) && value >= 0.0, name, value, ">= 0");
}

void require_positive(const char* name, double value) {
  require(std::isfinite(value) && value > 0.0, name, value, "> 0");
}

// Standard deviation of what the driving noise adds to the bias in one period.
double exact_step_stddev(const GaussMarkovParams& params, double dt) {
  const double tau = params.correlation_time;
  // The limit for tau -> infinity is the random walk.
  if (std::isinf(tau)) return params.random_walk * std::sqrt(dt);
  return params.random_walk * std::sqrt(-0.5 * tau * std::expm1(-2.0 * dt / tau));
}

}  // namespace

/// Without noise no random number is drawn: it costs more than the rest of a sample.
double GaussianNoise::sample(const RandomStream& stream, std::uint64_t index,
                             std::uint32_t channel) const {
  return stddev == 0.0 ? mean : mean + stddev * stream.normal(index, channel);
}

/// A density [unit/sqrt(Hz)] that is sampled at 1 /
/// dt has the standard deviation density / sqrt(dt).
double WhiteNoise::sample(const RandomStream& stream, std::uint64_t index, std::uint32_t channel,
                          double dt) const {
  return density == 0.0 ? 0.0 : density / std::sqrt(dt) * stream.normal(index, channel);
}

double UniformNoise::sample(const RandomStream& stream, std::uint64_t index,
                            std::uint32_t channel) const {
  return lower == upper ? lower : lower + (upper - lower) * stream.uniform(index, channel);
}

/// One channel per axis: axes are independent, and setting one to zero does not change the others.
Eigen::Vector3d GaussianNoise3::sample(const RandomStream& stream, std::uint64_t index,
                                       std::uint32_t channel) const {
  Eigen::Vector3d result;
  for (std::uint32_t i = 0; i < kAxes; ++i) {
    result[i] = GaussianNoise{mean[i], stddev[i]}.sample(stream, index, channel + i);
  }
  return result;
}

Eigen::Vector3d UniformNoise3::sample(const RandomStream& stream, std::uint64_t index,
                                      std::uint32_t channel) const {
  Eigen::Vector3d result;
  for (std::uint32_t i = 0; i < kAxes; ++i) {
    result[i] = UniformNoise{lower[i], upper[i]}.sample(stream, index, channel + i);
  }
  return result;
}

GaussMarkov::GaussMarkov(const GaussMarkovParams& params, double dt, std::uint32_t channel)
    : decay_(std::exp(-dt / params.correlation_time)),
      step_stddev_(exact_step_stddev(params, dt)),
      turn_on_stddev_(params.turn_on_stddev),
      channel_(channel) {
  require_positive("sample period [s]", dt);
  require_non_negative("random walk", params.random_walk);
  require_non_negative("turn-on bias sigma", params.turn_on_stddev);
  require(params.correlation_time > 0.0, "bias correlation time [s]", params.correlation_time,
          "> 0");
}

double GaussMarkov::sample(const RandomStream& stream, std::uint64_t index) {
  // The bias is a chain. An earlier index than the last one begins it again; indices that were left
  // out are worked through, so that a sample depends on its index alone.
  if (index + 1 < next_index_) reset();
  if (next_index_ == 0 && turn_on_stddev_ > 0.0) {
    turn_on_ = turn_on_stddev_ * stream.normal(0, channel_ + kTurnOnChannelOffset);
  }
  // A constant bias needs no chain.
  if (step_stddev_ == 0.0) next_index_ = index + 1;
  for (; next_index_ <= index; ++next_index_) {
    // The exact discretization of a first-order Gauss-Markov process, for any step.
    bias_ = decay_ * bias_ + step_stddev_ * stream.normal(next_index_, channel_);
  }
  return turn_on_ + bias_;
}

void GaussMarkov::reset() {
  next_index_ = 0;
  bias_ = 0.0;
  turn_on_ = 0.0;
}

ImuNoise::ImuNoise(const ImuNoiseParams& params, double dt, const RandomStream& stream)
    : stream_(stream),
      dt_(dt),
      gyroscope_(make_triad(params.gyroscope, dt, kGyroscopeChannel)),
      accelerometer_(make_triad(params.accelerometer, dt, kAccelerometerChannel)) {}

ImuNoise::Triad ImuNoise::make_triad(const InertialNoiseParams& params, double dt,
                                     std::uint32_t channel) {
  require_non_negative("noise density", params.noise_density);
  const auto bias = [&](std::uint32_t axis) {
    return GaussMarkov(params.bias, dt, channel + kBiasChannel + axis);
  };
  return {{params.noise_density}, {bias(0), bias(1), bias(2)}, channel + kWhiteChannel};
}

void ImuNoise::add(std::uint64_t index, Eigen::Vector3d* w_sensor, Eigen::Vector3d* f_sensor) {
  add(&gyroscope_, index, w_sensor);
  add(&accelerometer_, index, f_sensor);
}

void ImuNoise::add(Triad* triad, std::uint64_t index, Eigen::Vector3d* value) const {
  for (std::uint32_t i = 0; i < kAxes; ++i) {
    (*value)[i] += triad->bias[i].sample(stream_, index) +
                   triad->white.sample(stream_, index, triad->channel + i, dt_);
  }
}

void ImuNoise::reset() {
  for (Triad* triad : {&gyroscope_, &accelerometer_}) {
    for (GaussMarkov& bias : triad->bias) bias.reset();
  }
}

}  // namespace trident
