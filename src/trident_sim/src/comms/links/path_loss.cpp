// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/links/path_loss.h"

#include <algorithm>

namespace trident::sim {
namespace {

// An antenna is no nearer to the water than this: waves wet it [m].
constexpr double kMinHeight_m = 0.05;
// Water that is shallower reflects less and less, so that shores are no steps [m].
constexpr double kShallow_m = 0.3;

}  // namespace

double channel_frequency_hz(int channel) { return 5e9 + 5e6 * channel; }

double PathLoss::over_distance_db(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  double wavelength_m, const Sea* sea, double time_s) const {
  const double distance_m = (b - a).norm();
  if (params_.model == PathModel::kLogDistance) {
    return log_distance_loss_db(distance_m, wavelength_m, params_.exponent);
  }
  const bool has_water = params_.model == PathModel::kTwoRay && sea != nullptr;
  if (!has_water) return free_space_loss_db(distance_m, wavelength_m);
  return over_water_db(a, b, wavelength_m, *sea, time_s);
}

double PathLoss::over_water_db(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               double wavelength_m, const Sea& sea, double time_s) const {
  const double level_m = sea.still_level_m(time_s);
  OverWater over;
  over.distance_m = std::max((b - a).head<2>().norm(), 1e-3);
  over.height1_m = std::max(a.z() - level_m, kMinHeight_m);
  over.height2_m = std::max(b.z() - level_m, kMinHeight_m);
  over.wavelength_m = wavelength_m;
  over.polarization = params_.polarization;
  over.water = params_.water;
  over.water.significant_height_m = sea.significant_height_m();
  // Where the reflected wave hits the water.
  const double along = over.height1_m / (over.height1_m + over.height2_m);
  const Eigen::Vector2d place = a.head<2>() + along * (b - a).head<2>();
  over.reflecting_share = std::clamp(sea.depth_m(place, time_s) / kShallow_m, 0.0, 1.0);
  return two_ray_loss_db(over) +
         over.reflecting_share *
             bulge_loss_db(over.distance_m, over.height1_m, over.height2_m, wavelength_m);
}

}  // namespace trident::sim
