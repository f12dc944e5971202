// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace trident::trajectories {

/// A polynomial on 0 ... 1 by its Bernstein coefficients: its values lie between the least and the
/// greatest of them (the curve lies in the hull of its control points; Farouki, 2012).
struct Bernstein {
  static constexpr int kMaxDegree = 24;  ///< (v^2)^3 of curves of degree 5

  int degree = 0;
  std::array<double, kMaxDegree + 1> c = {};

  double least() const;     ///< of the coefficients
  double greatest() const;  ///< of the coefficients
  double at_begin() const { return c[0]; }
  double at_end() const { return c[degree]; }

  /// The same polynomial with more coefficients.
  Bernstein elevated(int to) const;
  /// Derivative by u.
  Bernstein derivative() const;
  /// The two halves, each on 0 ... 1 again (de Casteljau).
  void split(Bernstein& left, Bernstein& right) const;
};

/// Sum, difference and product; degrees need not be equal.
Bernstein operator+(const Bernstein& a, const Bernstein& b);
Bernstein operator-(const Bernstein& a, const Bernstein& b);
Bernstein operator*(const Bernstein& a, const Bernstein& b);
/// Products and sums with numbers.
Bernstein operator*(double factor, const Bernstein& a);
Bernstein operator+(const Bernstein& a, double constant);

/// The greatest value of something on 0 ... 1, and where.
struct Greatest {
  double value = 0.0;
  double u = 0.0;
};

/// The greatest value of top / bottom, where bottom > 0, to within `tolerance`: never below it by
/// more. Values below `floor` are not looked for: then something <= floor is returned.
Greatest greatest_ratio(const Bernstein& top, const Bernstein& bottom, double floor,
                        double tolerance);

}  // namespace trident::trajectories
