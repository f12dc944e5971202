// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/prediction.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "trident_base/error.h"

namespace trident::trajectories {
namespace {

bool is_finite(const Prediction::Knot& knot) {
  return std::isfinite(knot.t) && knot.p.allFinite() && knot.v.allFinite();
}

}  // namespace

Prediction::Prediction(std::vector<Knot> knots) : knots_(std::move(knots)) {
  if (knots_.empty()) throw Error("prediction: no knot; legal are 1 or more");
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const Knot& knot = knots_[i];
    const std::string where = "prediction: knot " + std::to_string(i) + ": ";
    if (!is_finite(knot)) throw Error(where + "a value is not finite; legal are finite numbers");
    if (i > 0 && knot.t <= knots_[i - 1].t)
      throw Error(where + "t is " + std::to_string(knot.t) + "; legal are times after " +
                  std::to_string(knots_[i - 1].t));
    times_.push_back(knot.t);
  }
}

Prediction Prediction::constant_velocity(const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  return Prediction({Knot{0.0, p, v}});
}

std::size_t Prediction::piece(double t) const {
  const auto after = std::upper_bound(times_.begin(), times_.end(), t);
  return static_cast<std::size_t>(after - times_.begin()) - 1;
}

MotionState Prediction::at(double t) const {
  if (t < times_.front())
    return {
        knots_.front().p + (t - times_.front()) * knots_.front().v, knots_.front().v, {0, 0, 0}};
  if (t >= times_.back())
    return {knots_.back().p + (t - times_.back()) * knots_.back().v, knots_.back().v, {0, 0, 0}};
  const Knot& from = knots_[piece(t)];
  const Knot& to = *(&from + 1);
  const double h = to.t - from.t, u = (t - from.t) / h;
  const Eigen::Vector3d delta = to.p - from.p, v0 = h * from.v, v1 = h * to.v;
  const Eigen::Vector3d c2 = 3.0 * delta - 2.0 * v0 - v1, c3 = v0 + v1 - 2.0 * delta;
  return {from.p + u * (v0 + u * (c2 + u * c3)), (v0 + u * (2.0 * c2 + 3.0 * u * c3)) / h,
          (2.0 * c2 + 6.0 * u * c3) / (h * h)};
}

Eigen::Vector3d Prediction::jerk(double t) const {
  if (t < times_.front() || t >= times_.back()) return Eigen::Vector3d::Zero();
  const Knot& from = knots_[piece(t)];
  const Knot& to = *(&from + 1);
  const double h = to.t - from.t;
  return 6.0 * (h * (from.v + to.v) - 2.0 * (to.p - from.p)) / (h * h * h);
}

}  // namespace trident::trajectories
