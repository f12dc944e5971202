// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "wave_spectrum.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

constexpr double kLowestPart = 0.5, kHighestPart = 4.0;  // of the peak frequency

double integral(const std::function<double(double)>& f, double lo, double hi, int steps) {
  double sum = 0.0;
  const double width = (hi - lo) / steps;
  for (int i = 0; i < steps; ++i) sum += f(lo + (i + 0.5) * width);
  return sum * width;
}

Eigen::Vector2d unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// The angle at which the distribution cos^2s(angle / 2) has the share `quantile` below it.
double spread_angle(double s, double quantile) {
  constexpr int kSteps = 720;
  const auto density = [s](double angle) { return std::pow(std::cos(0.5 * angle), 2.0 * s); };
  const double total = integral(density, -kPi, kPi, kSteps);
  const double width = 2.0 * kPi / kSteps;
  double below = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double step = density(-kPi + (i + 0.5) * width) * width / total;
    if (below + step >= quantile) return -kPi + (i + (quantile - below) / step) * width;
    below += step;
  }
  return kPi;
}

std::vector<WaveComponent> spectral_waves(const WaveParams& params, std::uint64_t seed) {
  enum Channel : std::uint32_t { kFrequency, kPhase, kDirection };
  const RandomStream stream(seed, "waves");
  const SpectralDensity density(params);
  const double peak = 2.0 * kPi / params.peak_period;
  const double width = (kHighestPart - kLowestPart) * peak / params.components;
  std::vector<WaveComponent> waves;
  double energy = 0.0;
  for (int i = 0; i < params.components; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const double lo = kLowestPart * peak + i * width;
    WaveComponent wave;
    // A random frequency in each band: with equal spacing the sea would repeat after 2 pi / width.
    wave.omega_rad_s = lo + stream.uniform(index, kFrequency) * width;
    const double in_band = integral(density, lo, lo + width, 16);
    // A component's variance a^2 / 2 is the energy of its band.
    wave.amplitude_m = std::sqrt(2.0 * in_band);
    wave.k = wave_number(wave.omega_rad_s, params.depth, params.gravity);
    wave.phase_rad = 2.0 * kPi * stream.uniform(index, kPhase);
    const double angle = params.spreading > 0.0
                             ? spread_angle(params.spreading, stream.uniform(index, kDirection))
                             : 0.0;
    wave.direction = unit(params.direction + angle);
    energy += in_band;
    waves.push_back(wave);
  }
  // What the range of frequencies cuts off is made up
  // for, so that the height is as given: m0 = Hs^2 / 16.
  const double wanted = params.significant_height * params.significant_height / 16.0;
  const double factor = energy > 0.0 ? std::sqrt(wanted / energy) : 0.0;
  for (WaveComponent& wave : waves) wave.amplitude_m *= factor;
  return waves;
}

/// VRX' samples: frequencies omega_p scale^(-1, 0, 1), deep water.
std::vector<WaveComponent> vrx_pms_waves(const WaveParams& params) {
  // Phillips' constant.
  constexpr double kPhillips = 0.0081;
  const double g = params.gravity, s = params.scale, peak = 2.0 * kPi / params.period;
  const std::array<double, 3> widths = {peak * (1.0 - 1.0 / s), peak * (s - 1.0 / s) / 2.0,
                                        peak * (s - 1.0)};
  std::vector<WaveComponent> waves;
  for (int i = 0; i < params.number; ++i) {
    WaveComponent wave;
    const double omega = peak * std::pow(s, i - 1);
    const double density =
        kPhillips * g * g / std::pow(omega, 5) * std::exp(-1.25 * std::pow(peak / omega, 4));
    wave.omega_rad_s = omega;
    wave.amplitude_m = params.gain * std::sqrt(2.0 * density * widths[static_cast<std::size_t>(i)]);
    wave.k = omega * omega / g;
    wave.phase_rad = params.phase;
    wave.direction = unit(params.direction + (i - 1) * params.angle);
    waves.push_back(wave);
  }
  return waves;
}

/// Amplitude and length scale together; the middle wave has the given period.
std::vector<WaveComponent> vrx_cwr_waves(const WaveParams& params) {
  const double omega = 2.0 * kPi / params.period;
  const double k = omega * omega / params.gravity;
  std::vector<WaveComponent> waves;
  for (int i = 0; i < params.number; ++i) {
    const int n = i - params.number / 2;
    const double factor = std::pow(params.scale, n);
    WaveComponent wave;
    wave.amplitude_m = factor * params.amplitude;
    wave.k = k / factor;
    wave.omega_rad_s = std::sqrt(params.gravity * wave.k);
    wave.phase_rad = params.phase;
    wave.direction = unit(params.direction + n * params.angle);
    waves.push_back(wave);
  }
  return waves;
}

std::vector<WaveComponent> regular_wave(const WaveParams& params) {
  WaveComponent wave;
  wave.amplitude_m = params.amplitude;
  wave.omega_rad_s = 2.0 * kPi / params.period;
  wave.k = wave_number(wave.omega_rad_s, params.depth, params.gravity);
  wave.phase_rad = params.phase;
  wave.direction = unit(params.direction);
  return {wave};
}

void check(const char* name, double value, Range range) {
  if (!range.contains(value)) {
    throw Error(std::string("waves: ") + name + " = " + number_text(value) + ", legal is " +
                range.text());
  }
}

}  // namespace

void WaveParams::validate() const {
  check("significant_height", significant_height, Range{0.0, 30.0});
  check("amplitude", amplitude, Range{0.0, 15.0});
  check("peak_period", peak_period, Range{0.2, 40.0});
  check("period", period, Range{0.2, 40.0});
  check("depth", depth, Range::positive().or_infinite());
  check("components", components, Range{1.0, 5000.0});
  check("number", number, Range{1.0, 3.0});
  if (spectrum != WaveSpectrum::kRegular) return;
  const double k = wave_number(2.0 * kPi / period, depth, gravity);
  // Waves break at a height of a seventh of their length.
  const double highest = 2.0 * kPi / k / 7.0;
  if (2.0 * amplitude > highest) {
    throw Error("waves: amplitude = " + number_text(amplitude) + " m breaks at period = " +
                number_text(period) + " s, legal is <= " + number_text(0.5 * highest) + " m");
  }
}

double wave_number(double omega_rad_s, double depth_m, double gravity_m_s2) {
  const double deep = omega_rad_s * omega_rad_s / gravity_m_s2;
  if (deep * depth_m > 20.0) return deep;  // tanh is 1 to the last digit
  // y = k depth solves y tanh(y) = deep depth; Eckart's formula is within 5 %.
  const double wanted = deep * depth_m;
  double y = wanted / std::sqrt(std::tanh(wanted));
  for (int i = 0; i < 20; ++i) {
    const double tanh_y = std::tanh(y);
    const double step = (y * tanh_y - wanted) / (tanh_y + y * (1.0 - tanh_y * tanh_y));
    y -= step;
    if (std::abs(step) < 1e-14 * y) break;
  }
  return y / depth_m;
}

SpectralDensity::SpectralDensity(const WaveParams& params)
    : peak_rad_s_(2.0 * kPi / params.peak_period),
      enhancement_(params.spectrum == WaveSpectrum::kJonswap ? params.peak_enhancement : 1.0) {
  const double total =
      integral([this](double w) { return shape(w); }, 0.3 * peak_rad_s_, 20.0 * peak_rad_s_, 20000);
  scale_ = params.significant_height * params.significant_height / 16.0 / total;
}

double SpectralDensity::shape(double omega_rad_s) const {
  const double x = omega_rad_s / peak_rad_s_;
  if (x < 0.1) return 0.0;
  // JONSWAP's peak is narrower below the peak frequency than above it (Hasselmann et al. 1973).
  const double sigma = x <= 1.0 ? 0.07 : 0.09;
  const double r = std::exp(-0.5 * std::pow((x - 1.0) / sigma, 2));
  return std::pow(x, -5) * std::exp(-1.25 * std::pow(x, -4)) * std::pow(enhancement_, r);
}

std::vector<WaveComponent> make_waves(const WaveParams& params, std::uint64_t seed) {
  params.validate();
  switch (params.spectrum) {
    case WaveSpectrum::kNone:
      return {};
    case WaveSpectrum::kRegular:
      return regular_wave(params);
    case WaveSpectrum::kPiersonMoskowitz:
    case WaveSpectrum::kJonswap:
      return spectral_waves(params, seed);
    case WaveSpectrum::kVrxPms:
      return vrx_pms_waves(params);
    case WaveSpectrum::kVrxCwr:
      return vrx_cwr_waves(params);
  }
  return {};
}

}  // namespace trident::sim
