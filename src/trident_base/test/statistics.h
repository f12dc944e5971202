// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace trident {

struct Moments {
  double mean;
  double variance;
  double skewness;
  double kurtosis;  ///< 3 for a normal distribution.
};

inline Moments moments(const std::vector<double>& samples) {
  const double n = static_cast<double>(samples.size());
  double mean = 0.0;
  for (const double x : samples) mean += x / n;
  double m2 = 0.0;
  double m3 = 0.0;
  double m4 = 0.0;
  for (const double x : samples) {
    const double d = x - mean;
    m2 += d * d / n;
    m3 += d * d * d / n;
    m4 += d * d * d * d / n;
  }
  return {mean, m2, m3 / std::pow(m2, 1.5), m4 / (m2 * m2)};
}

/// Pearson's coefficient; for independent samples it is 0 +- 1/sqrt(n).
inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = moments(a).mean;
  const double mean_b = moments(b).mean;
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

/// Kolmogorov-Smirnov: sqrt(n) times the largest distance between the samples' distribution and
/// `cumulative`. Above 1.95 with probability 0.001.
template <class Cumulative>
double kolmogorov_smirnov(std::vector<double> samples, Cumulative cumulative) {
  std::sort(samples.begin(), samples.end());
  const double n = static_cast<double>(samples.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double expected = cumulative(samples[i]);
    worst = std::max({worst, std::abs(expected - static_cast<double>(i) / n),
                      std::abs(expected - static_cast<double>(i + 1) / n)});
  }
  return worst * std::sqrt(n);
}

/// n values of `draw(i)`.
template <class Draw>
std::vector<double> draw_samples(std::size_t n, Draw draw) {
  std::vector<double> result(n);
  for (std::size_t i = 0; i < n; ++i) result[i] = draw(i);
  return result;
}

}  // namespace trident
