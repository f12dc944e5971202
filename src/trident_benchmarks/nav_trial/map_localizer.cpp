// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "map_localizer.h"

#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"

namespace trident::benchmarks {

MapLocalizer::MapLocalizer(const MapParams& params, const OccupancyGrid& map,
                           const SE2& T_map_start, std::uint64_t seed)
    : how_(params.localization), T_map_odom_(T_map_start) {
  if (how_ != Localization::kAmcl) return;
  auto amcl = load_yaml<estimation::AmclParams>(params.amcl);
  amcl.seed = seed;
  filter_ = std::make_unique<estimation::Amcl>(amcl, map);
  const RandomStream random(seed, "amcl_start");
  const auto& sigma = params.start_sigma;
  const SE2 T_map_given =
      T_map_start * SE2::from_xy_yaw(sigma[0] * random.normal(0, 0), sigma[1] * random.normal(0, 1),
                                     sigma[2] * random.normal(0, 2));
  const Eigen::Vector3d spread(sigma[0], sigma[1], sigma[2]);
  filter_->set_pose(T_map_given, spread.cwiseAbs2().asDiagonal());
  T_map_odom_ = T_map_given;
}

void MapLocalizer::add_scan(const PlacedScan& placed) {
  if (!filter_) return;
  const auto step = filter_->update(placed.scan, placed.T_odom_base, placed.T_start_end);
  if (step.is_updated) {
    T_map_odom_ = filter_->estimate().T_map_base * placed.T_odom_base.inverse();
  }
}

void MapLocalizer::set_truth(const SE2& T_map_base, const SE2& T_odom_base) {
  if (how_ == Localization::kTruth) T_map_odom_ = T_map_base * T_odom_base.inverse();
}

}  // namespace trident::benchmarks
