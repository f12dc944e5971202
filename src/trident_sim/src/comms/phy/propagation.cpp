// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/phy/propagation.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kSpeedOfLight_m_s = 299792458.0;

/// Of a wave that hits the water at a grazing angle, relative to the one that comes.
std::complex<double> fresnel_coefficient(const OverWater& geometry, double sine) {
  const WaterMirror& water = geometry.water;
  // The complex relative permittivity, eps_r - j 60 sigma lambda.
  const std::complex<double> eps(water.relative_permittivity,
                                 -60.0 * water.conductivity_s_m * geometry.wavelength_m);
  const std::complex<double> root = std::sqrt(eps - (1.0 - sine * sine));
  if (geometry.polarization == Polarization::kHorizontal) return (sine - root) / (sine + root);
  return (eps * sine - root) / (eps * sine + root);
}

}  // namespace

double wavelength_m(double frequency_hz) { return kSpeedOfLight_m_s / frequency_hz; }

double free_space_loss_db(double distance_m, double wavelength_m) {
  // Friis' equation holds in the far field only, hence the least distance.
  return 20.0 * std::log10(4.0 * kPi * std::max(distance_m, wavelength_m) / wavelength_m);
}

double log_distance_loss_db(double distance_m, double wavelength_m, double exponent,
                            double reference_m) {
  const double beyond = std::max(distance_m / reference_m, 1.0);
  return free_space_loss_db(std::min(distance_m, reference_m), wavelength_m) +
         10.0 * exponent * std::log10(beyond);
}

double two_ray_loss_db(const OverWater& geometry) {
  constexpr double kMaxFade_db = 60.0;
  const double sum_m = geometry.height1_m + geometry.height2_m;
  const double difference_m = geometry.height1_m - geometry.height2_m;
  const double direct_m = std::hypot(geometry.distance_m, difference_m);
  const double reflected_m = std::hypot(geometry.distance_m, sum_m);
  const double sine = sum_m / reflected_m;
  // A rough surface reflects exp(-2 (2 pi sigma sin / lambda)^2) of the amplitude coherently (Ament
  // 1953), with the standard deviation of the heights, Hs / 4.
  const double rough_m = geometry.water.significant_height_m / 4.0;
  const double phase_error = 2.0 * kPi * rough_m * sine / geometry.wavelength_m;
  const double coherent = std::exp(-2.0 * phase_error * phase_error);
  // Of the difference of both paths, which itself would lose digits.
  const double longer_m = 4.0 * geometry.height1_m * geometry.height2_m / (direct_m + reflected_m);
  const double phase = -2.0 * kPi * longer_m / geometry.wavelength_m;
  const std::complex<double> reflected = geometry.reflecting_share * coherent *
                                         fresnel_coefficient(geometry, sine) *
                                         std::polar(direct_m / reflected_m, phase);
  const double gain_db = 20.0 * std::log10(std::max(std::abs(1.0 + reflected), 1e-30));
  return free_space_loss_db(direct_m, geometry.wavelength_m) - std::max(gain_db, -kMaxFade_db);
}

double knife_edge_loss_db(double v) {
  if (v <= -0.78) return 0.0;
  const double shifted = v - 0.1;
  return std::max(6.9 + 20.0 * std::log10(std::sqrt(shifted * shifted + 1.0) + shifted), 0.0);
}

double diffraction_parameter(double height_m, double d1_m, double d2_m, double wavelength_m) {
  return height_m * std::sqrt(2.0 / wavelength_m * (1.0 / d1_m + 1.0 / d2_m));
}

double bulge_loss_db(double distance_m, double height1_m, double height2_m, double wavelength_m) {
  // Waves bend in a standard atmosphere as if the Earth were larger by a third.
  constexpr double kEffectiveRadius_m = 4.0 / 3.0 * 6371e3;
  const double half_m = 0.5 * distance_m;
  const double path_m = 0.5 * (height1_m + height2_m);
  const double bulge_m = half_m * half_m / (2.0 * kEffectiveRadius_m);
  const auto loss = [&](double height_m) {
    return knife_edge_loss_db(diffraction_parameter(height_m, half_m, half_m, wavelength_m));
  };
  return loss(bulge_m - path_m) - loss(-path_m);
}

}  // namespace trident::sim
