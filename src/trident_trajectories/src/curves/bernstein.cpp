// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "curves/bernstein.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace trident::trajectories {
namespace {

constexpr int kMaxParts = 20000;  // that are looked at; what is left then counts by its bound
constexpr int kMaxDepth = 40;     // of halvings: below that doubles do not distinguish values

using Binomials =
    std::array<std::array<double, Bernstein::kMaxDegree + 1>, Bernstein::kMaxDegree + 1>;

constexpr Binomials binomials() {
  Binomials out = {};
  for (int n = 0; n <= Bernstein::kMaxDegree; ++n) {
    out[n][0] = 1.0;
    for (int k = 1; k <= n; ++k) out[n][k] = out[n - 1][k - 1] + (k < n ? out[n - 1][k] : 0.0);
  }
  return out;
}
constexpr Binomials kBinomials = binomials();

/// A part of 0 ... 1 that is still looked at.
struct Part {
  Bernstein top, bottom;
  double begin, length;
  int depth;
};

/// The rational curve lies in the hull of its coefficients' ratios where its weights are positive;
/// elsewhere nothing is known yet.
double bound(const Part& part) {
  if (part.bottom.least() <= 0.0) return std::numeric_limits<double>::infinity();
  double greatest = part.top.c[0] / part.bottom.c[0];
  for (int i = 1; i <= part.top.degree; ++i)
    greatest = std::max(greatest, part.top.c[i] / part.bottom.c[i]);
  return greatest;
}

void keep_better(double value, double u, Greatest& best) {
  if (value > best.value) best = {value, u};
}

void look_at_ends(const Part& part, Greatest& best) {
  keep_better(part.top.at_begin() / part.bottom.at_begin(), part.begin, best);
  keep_better(part.top.at_end() / part.bottom.at_end(), part.begin + part.length, best);
}

}  // namespace

double Bernstein::least() const { return *std::min_element(c.begin(), c.begin() + degree + 1); }

double Bernstein::greatest() const { return *std::max_element(c.begin(), c.begin() + degree + 1); }

Bernstein Bernstein::elevated(int to) const {
  Bernstein one;
  one.degree = to - degree;
  std::fill(one.c.begin(), one.c.begin() + one.degree + 1, 1.0);
  return to == degree ? *this : one * *this;
}

Bernstein Bernstein::derivative() const {
  Bernstein out;
  out.degree = std::max(0, degree - 1);
  for (int i = 0; i < degree; ++i) out.c[i] = degree * (c[i + 1] - c[i]);
  return out;
}

void Bernstein::split(Bernstein& left, Bernstein& right) const {
  right = *this;
  left.degree = degree;
  left.c[0] = c[0];
  for (int step = 1; step <= degree; ++step) {
    for (int i = 0; i <= degree - step; ++i) right.c[i] = 0.5 * (right.c[i] + right.c[i + 1]);
    left.c[step] = right.c[0];
  }
}

Bernstein operator+(const Bernstein& a, const Bernstein& b) {
  const int degree = std::max(a.degree, b.degree);
  Bernstein out = a.elevated(degree);
  const Bernstein other = b.elevated(degree);
  for (int i = 0; i <= degree; ++i) out.c[i] += other.c[i];
  return out;
}

Bernstein operator-(const Bernstein& a, const Bernstein& b) { return a + (-1.0) * b; }

Bernstein operator*(double factor, const Bernstein& a) {
  Bernstein out = a;
  for (int i = 0; i <= a.degree; ++i) out.c[i] *= factor;
  return out;
}

Bernstein operator+(const Bernstein& a, double constant) {
  Bernstein out = a;
  for (int i = 0; i <= a.degree; ++i) out.c[i] += constant;
  return out;
}

// Equation (44) of Farouki, "The Bernstein polynomial basis: a centennial retrospective", 2012.
Bernstein operator*(const Bernstein& a, const Bernstein& b) {
  Bernstein out;
  out.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i) {
    const double left = kBinomials[a.degree][i] * a.c[i];
    for (int j = 0; j <= b.degree; ++j) out.c[i + j] += left * kBinomials[b.degree][j] * b.c[j];
  }
  for (int k = 0; k <= out.degree; ++k) out.c[k] /= kBinomials[out.degree][k];
  return out;
}

Greatest greatest_ratio(const Bernstein& top, const Bernstein& bottom, double floor,
                        double tolerance) {
  const int degree = std::max(top.degree, bottom.degree);
  Part whole{top.elevated(degree), bottom.elevated(degree), 0.0, 1.0, 0};
  Greatest best{whole.top.at_begin() / whole.bottom.at_begin(), 0.0};
  look_at_ends(whole, best);
  if (bound(whole) <= std::max(best.value, floor)) return best;
  std::vector<Part> parts = {whole};
  for (int looked_at = 0; !parts.empty(); ++looked_at) {
    const Part part = parts.back();
    parts.pop_back();
    if (looked_at > kMaxParts || !std::isfinite(part.top.at_begin()))
      return {std::max(best.value, bound(part)), part.begin};
    if (bound(part) <= std::max(best.value + tolerance, floor) || part.depth > kMaxDepth) continue;
    Part left{{}, {}, part.begin, 0.5 * part.length, part.depth + 1};
    Part right{{}, {}, part.begin + left.length, left.length, part.depth + 1};
    part.top.split(left.top, right.top);
    part.bottom.split(left.bottom, right.bottom);
    look_at_ends(right, best);
    parts.push_back(left);
    parts.push_back(right);
  }
  best.value += best.value > floor ? tolerance : 0.0;
  return best;
}

}  // namespace trident::trajectories
