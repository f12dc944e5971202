// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "axis_noise.h"

#include <cctype>
#include <cmath>

#include <Eigen/Core>

namespace trident::sim {
namespace {

constexpr double kLargest = 1e9;

AxisNoise read_axis_noise(const ParamNode& node, const std::string& owner) {
  const PluginParams params(node, owner + " <noise>");
  AxisNoise noise;
  noise.mean = params.number("mean", 0.0, {-kLargest, kLargest});
  noise.stddev = params.number("stddev", 0.0, {0.0, kLargest});
  noise.bias_mean = params.number("bias_mean", 0.0, {-kLargest, kLargest});
  noise.bias_stddev = params.number("bias_stddev", 0.0, {0.0, kLargest});
  noise.dynamic_bias_stddev = params.number("dynamic_bias_stddev", 0.0, {0.0, kLargest});
  noise.dynamic_bias_correlation_time_s =
      params.number("dynamic_bias_correlation_time", 0.0, {0.0, kLargest});
  return noise;
}

bool is_gaussian(const ParamNode& noise, const std::string& owner) {
  std::string type = PluginParams(noise, owner).text("type", "none");
  for (const auto& [key, value] : noise.attributes) {
    if (key == "type") type = value;
  }
  if (type == "none" || type.empty()) return false;
  if (type == "gaussian" || type == "gaussian_quantized") return true;
  PluginParams(noise, owner).refuse("noise type", type, "none, gaussian or gaussian_quantized");
}

/// Three numbers, or one for all axes.
Eigen::Vector3d numbers_of(const PluginParams& params, const std::string& key, double fallback,
                           const Limits& limits) {
  const std::string text = params.text(key, "");
  const bool is_one =
      text.find_first_of(" \t\n", text.find_first_not_of(" \t\n")) == std::string::npos;
  if (is_one) return Eigen::Vector3d::Constant(params.number(key, fallback, limits));
  Eigen::Vector3d values = params.vector3(key, Eigen::Vector3d::Constant(fallback));
  if (values.minCoeff() < limits.lo || values.maxCoeff() > limits.hi) {
    params.refuse(key, text, limits.lo < 0.0 ? "numbers up to 1e9" : "numbers in [0, 1e9]");
  }
  return values;
}

}  // namespace

std::array<AxisNoise, 3> read_hector_noises(const PluginParams& params, const std::string& prefix) {
  const auto read = [&](std::string name, double fallback, const Limits& limits) {
    if (!prefix.empty()) name[0] = static_cast<char>(std::toupper(name[0]));
    return numbers_of(params, prefix + name, fallback, limits);
  };
  const Limits positive{0.0, kLargest};
  const Eigen::Vector3d offset = read("offset", 0.0, {-kLargest, kLargest});
  const Eigen::Vector3d white = read("gaussianNoise", 0.0, positive);
  const Eigen::Vector3d drift = read("drift", 0.0, positive);
  const Eigen::Vector3d frequency = read("driftFrequency", 1.0 / 3600.0, positive);
  std::array<AxisNoise, 3> noises;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    noises[i].mean = offset[axis];
    noises[i].stddev = white[axis];
    // A frequency of zero: a drift that never changes, of which upstream's is zero.
    if (frequency[axis] <= 0.0) continue;
    noises[i].dynamic_bias_stddev = drift[axis];
    noises[i].dynamic_bias_correlation_time_s = 1.0 / frequency[axis];
  }
  return noises;
}

std::array<AxisNoise, 3> read_axis_noises(const ParamNode* element, const std::string& owner) {
  std::array<AxisNoise, 3> noises;
  if (element == nullptr) return noises;
  const char* const names[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const ParamNode* const axis = element->find(names[i]);
    const ParamNode* const noise = axis != nullptr ? axis->find("noise") : nullptr;
    const std::string what = owner + " <" + element->name + "> <" + names[i] + ">";
    if (noise != nullptr && is_gaussian(*noise, what)) noises[i] = read_axis_noise(*noise, what);
  }
  return noises;
}

AxisNoiseSource::AxisNoiseSource(const AxisNoise& noise, double dt_s, std::uint32_t channel)
    : noise_(noise), channel_(channel) {
  if (noise.dynamic_bias_stddev <= 0.0 || noise.dynamic_bias_correlation_time_s <= 0.0) return;
  // The driving noise that keeps the bias at its standard deviation.
  const double tau = noise.dynamic_bias_correlation_time_s;
  // A first-order Gauss-Markov process with driving noise q has the variance q^2 tau / 2.
  wandering_.emplace(GaussMarkovParams{noise.dynamic_bias_stddev * std::sqrt(2.0 / tau), tau, 0.0},
                     dt_s, channel + 3);
}

double AxisNoiseSource::sample(const RandomStream& stream, std::uint64_t index) {
  double value = noise_.mean;
  if (noise_.stddev > 0.0) value += noise_.stddev * stream.normal(index, channel_);
  if (noise_.bias_mean != 0.0 || noise_.bias_stddev > 0.0) {
    // Index 0 for every sample: the turn-on bias is drawn once and stays for the whole run.
    const double bias = noise_.bias_mean + noise_.bias_stddev * stream.normal(0, channel_ + 1);
    // As in Gazebo, the bias has either sign with equal probability.
    value += (stream.bits(0, channel_ + 1) & 1U) != 0U ? bias : -bias;
  }
  return wandering_ ? value + wandering_->sample(stream, index) : value;
}

double AxisNoiseSource::bias(const RandomStream& stream, std::uint64_t index) {
  const double white = noise_.stddev > 0.0 ? noise_.stddev * stream.normal(index, channel_) : 0.0;
  return sample(stream, index) - white;
}

void AxisNoiseSource::reset() {
  if (wandering_) wandering_->reset();
}

}  // namespace trident::sim
