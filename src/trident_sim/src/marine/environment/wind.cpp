// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "wind.h"

#include <cmath>

namespace trident::sim {
namespace {

DrydenParams dryden_of(const WindParams& params) {
  DrydenParams dryden;
  dryden.wind_at_6m = params.speed;
  dryden.altitude = params.altitude;
  return dryden;
}

}  // namespace

Wind::Wind(const WindParams& params, double dt_s, std::uint64_t seed, const std::string& name)
    : params_(params),
      first_order_({params.gust_deviation, params.gust_time}, dt_s, seed, name),
      dryden_(dryden_of(params), dt_s, seed, name) {
  const Eigen::Vector3d along(std::cos(params.direction), std::sin(params.direction), 0.0);
  mean_ = params.speed * along;
  left_ = {-along.y(), along.x(), 0.0};
  if (!params.file.empty()) {
    field_ = std::make_shared<const WindGrid>(read_wind_grid(params.file));
  }
  now_ = gust();
}

Eigen::Vector3d Wind::velocity(const Eigen::Vector3d& p_world) const {
  // Outside of the field, and without one, the mean wind blows; gusts add to both.
  return (field_ != nullptr ? wind_at(*field_, p_world).value_or(mean_) : mean_) + now_;
}

Eigen::Vector3d Wind::gust() const {
  if (params_.gusts == GustKind::kNone) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d local = params_.gusts == GustKind::kDryden
                                    ? dryden_.gust()
                                    : Eigen::Vector3d(first_order_.gust(), 0.0, 0.0);
  // Gusts are given along the mean wind, to its left and up.
  const Eigen::Vector3d along(left_.y(), -left_.x(), 0.0);
  return local.x() * along + local.y() * left_ + local.z() * Eigen::Vector3d::UnitZ();
}

void Wind::step() {
  if (params_.gusts == GustKind::kNone) return;
  if (params_.gusts == GustKind::kDryden) {
    dryden_.step();
  } else {
    first_order_.step();
  }
  now_ = gust();
}

void Wind::reset() {
  first_order_.reset();
  dryden_.reset();
  now_ = gust();
}

void Wind::continue_from(const Wind& other) {
  first_order_.continue_from(other.first_order_);
  dryden_.continue_from(other.dryden_);
  now_ = gust();
}

}  // namespace trident::sim
