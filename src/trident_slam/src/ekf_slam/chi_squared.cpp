// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "chi_squared.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMaxTerms = 100'000;
constexpr int kMaxSteps = 200;

/// Both tails of the gamma distribution, so that the small one keeps its digits.
struct Tails {
  double below;
  double above;
  double density;
};

/// Of x with shape a and scale 1, by the series (x < a + 1) or Lentz' continued fraction;
/// Abramowitz and Stegun 6.5.29 and 6.5.31.
Tails gamma_tails(double a, double x) {
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a;
    double sum = term;
    for (int n = 1; n < kMaxTerms && term > kEpsilon * sum; ++n) {
      term *= x / (a + n);
      sum += term;
    }
    return {front * sum, 1.0 - front * sum, front / x};
  }
  double b = x + 1.0 - a;
  double c = std::numeric_limits<double>::max();
  double d = 1.0 / b;
  double fraction = d;
  for (int n = 1; n < kMaxTerms; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    fraction *= c * d;
    if (std::abs(c * d - 1.0) <= kEpsilon) break;
  }
  return {1.0 - front * fraction, front * fraction, front / x};
}

/// Wilson and Hilferty (1931) with a crude normal quantile; only a start.
double rough_quantile(double probability, double degrees) {
  const double tail = std::min(probability, 1.0 - probability);
  const double t = std::sqrt(-2.0 * std::log(tail));
  const double z = t - (2.30753 + 0.27061 * t) / (1.0 + t * (0.99229 + t * 0.04481));
  const double c = 2.0 / (9.0 * degrees);
  const double root = 1.0 - c + (probability < 0.5 ? -z : z) * std::sqrt(c);
  return degrees * root * root * root;
}

/// Where Newton's iteration begins; where the rough quantile is not positive, from the first term
/// of the series of the lower tail, x^a / Gamma(a + 1).
double start_of(double probability, int degrees) {
  const double x = 0.5 * rough_quantile(probability, degrees);
  if (x > 0.0) return x;
  const double a = 0.5 * degrees;
  return std::exp((std::log(probability) + std::lgamma(a + 1.0)) / a);
}

/// The root of the tail's probability, between bounds that close in on it.
double find_quantile(double probability, double a, double x) {
  const bool is_upper = probability > 0.5;
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    const Tails tails = gamma_tails(a, x);
    const double miss = is_upper ? (1.0 - probability) - tails.above : tails.below - probability;
    (miss > 0.0 ? high : low) = x;
    double next = x - miss / tails.density;  // Newton, as long as it stays between the bounds
    if (!(next > low && next < high)) next = std::isinf(high) ? 2.0 * x : 0.5 * (low + high);
    const bool is_there = std::abs(next - x) <= 2.0 * kEpsilon * x;
    x = next;
    if (is_there) break;
  }
  return x;
}

}  // namespace

double chi_squared_quantile(double probability, int degrees) {
  if (!(probability > 0.0 && probability < 1.0) || degrees < 1) {
    throw Error("chi-squared quantile of probability " + std::to_string(probability) + " and " +
                std::to_string(degrees) + " degrees of freedom; legal: (0, 1) and 1 or more");
  }
  if (degrees == 2) return -2.0 * std::log1p(-probability);
  const double start = start_of(probability, degrees);
  return 2.0 * find_quantile(probability, 0.5 * degrees, start);
}

}  // namespace trident::slam
