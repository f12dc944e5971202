// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/filter/trust.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::estimation {
namespace {

constexpr double kMaxInflation = 1e12;
constexpr double kStep = 0.05;       // of the logarithm of an inflation, at each measurement
constexpr double kLargeStep = 0.25;  // the same where nearly all are too far
constexpr double kNearlyAll = 0.9;
constexpr int kMaxFourfold = 20;

// Of chi-squared with n degrees of freedom, at the quantile z of the standard normal.
double chi_squared(Eigen::Index n, double z) {
  const double k = 2.0 / (9.0 * static_cast<double>(n));
  return static_cast<double>(n) * std::pow(std::max(1.0 - k + z * std::sqrt(k), 0.0), 3);
}

// Of the standard normal, by halving.
double normal_quantile(double share) {
  double low = -8.0, high = 8.0;
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(-z / std::sqrt(2.0)) < share ? low : high) = z;
  }
  return low;
}

// More where its newest measurement was too far, less where it was not.
void inflate(bool is_far, Trust::Source& source) {
  const double step = source.share > kNearlyAll ? kLargeStep : kStep;
  source.inflation *= std::exp(is_far ? step : -step);
  source.inflation = std::clamp(source.inflation, 1.0, kMaxInflation);
}

}  // namespace

double gate_of(double share, Eigen::Index size) {
  return std::sqrt(chi_squared(size, normal_quantile(share)));
}

void TrustParams::validate() const {
  if (!(too_far > 0.5 && too_far < 1.0)) {
    throw Error("too_far is " + number_text(too_far) + ", legal is in (0.5, 1)");
  }
  if (!(memory >= 1.0 && std::isfinite(memory))) {
    throw Error("memory is " + number_text(memory) + ", legal is at least 1");
  }
  if (patience < 1) {
    throw Error("patience is " + std::to_string(patience) + ", legal is at least 1");
  }
}

double Trust::inflation(std::size_t source) const {
  return source < sources_.size() ? sources_[source].inflation : 1.0;
}

double Trust::widening(std::size_t source) const {
  if (source >= sources_.size()) return 1.0;
  const int over = sources_[source].gated_in_row - params_.patience;
  return std::ldexp(1.0, 2 * std::clamp(over, 0, kMaxFourfold));
}

// Whether a source's covariances are too small, or are inflated since they have been.
bool Trust::is_accused(const Source& source) const {
  const bool is_worst =
      std::all_of(sources_.begin(), sources_.end(),
                  [&source](const Source& other) { return other.share <= source.share; });
  return source.inflation > 1.0 || (source.share > params_.too_far && is_worst);
}

void Trust::note(std::size_t source, const Outcome& outcome) {
  if (outcome.kind == Outcome::Kind::kRefused) return;
  if (source >= sources_.size()) sources_.resize(source + 1);
  const bool is_far = outcome.normalized_squared > chi_squared(outcome.innovation.size(), 0.0);
  Source& own = sources_[source];
  own.gated_in_row = outcome.kind == Outcome::Kind::kGated ? own.gated_in_row + 1 : 0;
  own.share += ((is_far ? 1.0 : 0.0) - own.share) / params_.memory;
  if (is_accused(own)) inflate(is_far, own);
}

}  // namespace trident::estimation
