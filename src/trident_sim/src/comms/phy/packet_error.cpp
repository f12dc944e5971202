// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/phy/packet_error.h"

#include <array>
#include <cmath>

#include "comms/phy/vht.h"

namespace trident::sim {
namespace {

/// Ratios of signal to noise [dB] at which a frame is lost with that probability.
struct Waterfall {
  double long_1, long_10, long_90;  ///< 1500 bytes: 1 %, 10 %, 90 %
  double short_10;                  ///< 100 bytes: 10 %
};

// Measured with ns-3 3.37.
constexpr std::array<Waterfall, vht::kModes> kWaterfalls{{{1.58, 0.94, -0.21, 0.03},
                                                          {4.61, 3.95, 2.76, 3.06},
                                                          {7.13, 6.44, 5.22, 5.52},
                                                          {10.49, 9.72, 8.33, 8.60},
                                                          {13.58, 12.82, 11.55, 11.78},
                                                          {17.99, 17.06, 15.60, 15.89},
                                                          {19.32, 18.39, 16.95, 17.22},
                                                          {20.52, 19.65, 18.18, 18.71},
                                                          {24.78, 23.73, 22.09, 22.38},
                                                          {26.18, 25.17, 23.61, 23.90}}};

constexpr double kLongBytes = 1500.0, kShortBytes = 100.0;
constexpr std::size_t kShortest = 400;  // from here on a frame is a long one

/// ln(-ln(1 - loss)): a straight line over the ratio, about.
double strength(double loss) { return std::log(-std::log1p(-loss)); }

double long_strength(const Waterfall& curve, double snr_db) {
  static const double at_1 = strength(0.01), at_10 = strength(0.1), at_90 = strength(0.9);
  if (snr_db >= curve.long_10) {
    const double slope = (at_10 - at_1) / (curve.long_10 - curve.long_1);
    return at_10 + slope * (snr_db - curve.long_10);
  }
  const double slope = (at_90 - at_10) / (curve.long_90 - curve.long_10);
  return at_10 + slope * (snr_db - curve.long_10);
}

}  // namespace

double packet_error_rate(int mcs, double snr_db, std::size_t bytes) {
  const Waterfall& curve = kWaterfalls[static_cast<std::size_t>(mcs)];
  const bool is_short = bytes < kShortest;
  const double shifted_db = is_short ? snr_db + curve.long_10 - curve.short_10 : snr_db;
  const double length = static_cast<double>(bytes) / (is_short ? kShortBytes : kLongBytes);
  // Not beyond what exp() can hold: there the frame is lost.
  const double exponent = std::fmin(long_strength(curve, shifted_db), 50.0);
  return -std::expm1(-std::exp(exponent) * length);
}

double noise_power_dbm(double width_mhz, double noise_figure_db) {
  return -174.0 + 10.0 * std::log10(width_mhz * 1e6) + noise_figure_db;
}

}  // namespace trident::sim
