// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::sim {

/// Of a radio wave's electric field, against the water that reflects it.
enum class Polarization { kVertical, kHorizontal };

/// Water as a mirror for radio waves.
struct WaterMirror {
  double relative_permittivity = 70.0;
  double conductivity_s_m = 5.0;      ///< [S/m]
  double significant_height_m = 0.0;  ///< of the waves, Hs [m]
};

/// Two antennas over water.
struct OverWater {
  double distance_m = 0.0;        ///< over ground, > 0
  double height1_m = 0.0;         ///< of one antenna above the water, > 0
  double height2_m = 0.0;         ///< of the other, > 0
  double wavelength_m = 0.0;      ///< > 0
  double reflecting_share = 1.0;  ///< of the place of reflection that is water, in [0, 1]
  Polarization polarization = Polarization::kVertical;
  WaterMirror water;
};

/// Wavelength in vacuum [m] of a frequency [Hz].
double wavelength_m(double frequency_hz);

/// Friis: 20 log10(4 pi d / lambda) [dB]; of less than a wavelength as of a wavelength.
double free_space_loss_db(double distance_m, double wavelength_m);

/// Free space up to `reference_m`, then 10 n log10(d / reference) more [dB].
double log_distance_loss_db(double distance_m, double wavelength_m, double exponent,
                            double reference_m = 1.0);

/// The sum, with phases, of the direct wave and the one that the mean surface of the water
/// reflects, with Fresnel's coefficient for the water's complex permittivity, eps = eps_r - j 60
/// sigma lambda, and less coherent the rougher it is: exp(-2 (2 pi s sin(psi) / lambda)^2), s = Hs
/// / 4 (Ament) [dB]. At most 60 dB above free space, where both cancel each other.
double two_ray_loss_db(const OverWater& geometry);

/// Loss by an edge across the path, ITU-R P.526 equation 31: for v > -0.78
/// 6.9 + 20 log10(sqrt((v - 0.1)^2 + 1) + v - 0.1), else 0 [dB].
double knife_edge_loss_db(double v);

/// Fresnel's diffraction parameter v of an edge that is `height_m` above the straight path
/// (negative: below), at d1 and d2 [m] from its ends.
double diffraction_parameter(double height_m, double d1_m, double d2_m, double wavelength_m);

/// By how much the loss grows because the sea's surface bulges between two antennas, by a sphere of
/// 4/3 of the Earth's radius [dB].
double bulge_loss_db(double distance_m, double height1_m, double height2_m, double wavelength_m);

}  // namespace trident::sim
