// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ndt_match.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace trident::slam {
namespace {

/// Beyond this squared Mahalanobis distance a point adds less than 1e-5.
constexpr double kFar = 24.0;
constexpr double kOnSurface = 4.0;
/// A distribution that is wider than 5 cm in both directions is no surface: this is the least
/// trace of the information of one that is [1/m^2].
constexpr double kMinTrace = 400.0;

/// Adds exp(-q / 2) of one point and one distribution, as a part of the cost and its derivatives.
/// `arm` is R p; its derivatives by yaw are `side` and -arm.
double add_term(const NdtMap::Normal& normal, const Eigen::Vector2d& d, const Eigen::Vector2d& arm,
                PoseCost* sum) {
  const Eigen::Vector2d Bd = normal.information * d;
  const double q = d.dot(Bd);
  if (q > kFar) return q;
  constexpr double kShare = 1.0 / static_cast<double>(NdtMap::kGrids);
  const double e = kShare * std::exp(-0.5 * q);
  Eigen::Matrix<double, 2, 3> J;
  J << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  const Eigen::Vector3d slope = J.transpose() * Bd;  // half of q's gradient
  sum->cost -= e;
  sum->g += e * slope;
  sum->H += e * (J.transpose() * normal.information * J - slope * slope.transpose());
  sum->H(2, 2) -= e * Bd.dot(arm);
  return q;
}

}  // namespace

NdtMap::NdtMap(double cell, double least_sigma) : cell_(cell), least_sigma_(least_sigma) {}

std::array<int, 2> NdtMap::place(std::size_t g, const Eigen::Vector2d& p_ref) const {
  const double shift_x = (g & 1U) != 0 ? 0.5 : 0.0;
  const double shift_y = (g & 2U) != 0 ? 0.5 : 0.0;
  return {static_cast<int>(std::floor(p_ref.x() / cell_ + shift_x)),
          static_cast<int>(std::floor(p_ref.y() / cell_ + shift_y))};
}

void NdtMap::add(std::size_t g, const Eigen::Vector2d& p_ref) {
  const std::array<int, 2> at = place(g, p_ref);
  std::int32_t& number = index_[g].at(at[0], at[1]);
  if (number == 0) {
    cells_.emplace_back();
    number = static_cast<std::int32_t>(cells_.size());
  }
  Cell& cell = cells_[static_cast<std::size_t>(number - 1)];
  ++cell.count;
  const Eigen::Vector2d before = p_ref - cell.normal.mean;
  cell.normal.mean += before / cell.count;
  cell.scatter += before * (p_ref - cell.normal.mean).transpose();  // Welford 1962
  if (!cell.is_changed) changed_.push_back(static_cast<std::size_t>(number - 1));
  cell.is_changed = true;
}

void NdtMap::update_normal(Cell* cell) const {
  cell->is_changed = false;
  if (cell->count < kMinPoints) return;
  const Eigen::Matrix2d scatter = 0.5 * (cell->scatter + cell->scatter.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter / cell->count);
  const Eigen::Vector2d variances = solver.eigenvalues().cwiseMax(least_sigma_ * least_sigma_);
  const Eigen::Matrix2d& V = solver.eigenvectors();
  cell->normal.information = V * variances.cwiseInverse().asDiagonal() * V.transpose();
}

void NdtMap::insert(const SE2& T_ref_base, const PointScan& scan) {
  for (const SurfacePoint& point : scan.points) {
    const Eigen::Vector2d p_ref = T_ref_base * point.p.cast<double>();
    for (std::size_t g = 0; g < kGrids; ++g) add(g, p_ref);
  }
  for (const std::size_t i : changed_) update_normal(&cells_[i]);
  changed_.clear();
}

void NdtMap::clear() {
  index_ = {};
  cells_.clear();
}

const NdtMap::Normal* NdtMap::over(std::size_t g, const Eigen::Vector2d& p_ref) const {
  const std::array<int, 2> at = place(g, p_ref);
  const std::int32_t number = index_[g].get(at[0], at[1]);
  if (number == 0) return nullptr;
  const Cell& cell = cells_[static_cast<std::size_t>(number - 1)];
  return cell.count < kMinPoints ? nullptr : &cell.normal;
}

/// Overlapping grids, shifted by half a cell each (P. Biber and W. Strasser, "The Normal
/// Distributions Transform", 2003): the cost is smooth where one grid alone would jump at its
/// cells' borders.
PoseCost ndt_cost(const NdtMap& map, const PointScan& scan, const SE2& T_ref_base,
                  std::vector<char>* is_on_surface) {
  PoseCost sum;
  sum.cost = static_cast<double>(scan.points.size());
  if (is_on_surface != nullptr) is_on_surface->assign(scan.points.size(), 0);
  const Eigen::Matrix2d R = T_ref_base.rotation();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector2d arm = R * scan.points[i].p.cast<double>();
    const Eigen::Vector2d p_ref = T_ref_base.p + arm;
    for (std::size_t g = 0; g < NdtMap::kGrids; ++g) {
      const NdtMap::Normal* normal = map.over(g, p_ref);
      if (normal == nullptr) continue;
      const double q = add_term(*normal, p_ref - normal->mean, arm, &sum);
      if (is_on_surface != nullptr && q < kOnSurface && normal->information.trace() > kMinTrace) {
        (*is_on_surface)[i] = 1;
      }
    }
  }
  return sum;
}

}  // namespace trident::slam
