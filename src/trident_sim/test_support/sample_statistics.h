// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace trident::sim {

struct SampleStatistics {
  double mean = 0.0, stddev = 0.0;
};

inline SampleStatistics statistics_of(const std::vector<double>& samples) {
  const auto n = static_cast<double>(samples.size());
  SampleStatistics result;
  for (const double x : samples) result.mean += x / n;
  double variance = 0.0;
  for (const double x : samples) variance += (x - result.mean) * (x - result.mean) / (n - 1.0);
  result.stddev = std::sqrt(variance);
  return result;
}

/// Allan variance at the averaging time of `m` samples, from overlapping pairs of neighbouring
/// averages (IEEE Std 952-1997, annex C; overlapping: Riley, NIST SP 1065, eq. 10) [unit^2].
inline double allan_variance(const std::vector<double>& samples, std::size_t m) {
  std::vector<double> sums{0.0};
  sums.reserve(samples.size() + 1);
  for (const double x : samples) sums.push_back(sums.back() + x);
  const std::size_t pairs = samples.size() - 2 * m + 1;
  double squares = 0.0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const double difference =
        (sums[i + 2 * m] - 2.0 * sums[i + m] + sums[i]) / static_cast<double>(m);
    squares += difference * difference;
  }
  return squares / (2.0 * static_cast<double>(pairs));
}

/// Slope of the line through points (log x, log y) by least squares.
inline double log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace trident::sim
