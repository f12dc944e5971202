// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/slam_2d.h"

#include "logs/odometry_slam_2d.h"
#include "trident_slam/ekf_slam_2d.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/hector_slam_2d.h"
#include "trident_slam/particle_slam_2d.h"

namespace trident::slam {
namespace {

template <class Method, class Params>
void add_method(Registry<Slam2dFactory>& registry, const char* name) {
  registry.add(name, [](const std::string& config_file) -> std::unique_ptr<Slam2d> {
    return std::make_unique<Method>(config_file.empty() ? Params{}
                                                        : load_yaml<Params>(config_file));
  });
}

}  // namespace

void register_builtin_slam_2d(Registry<Slam2dFactory>& registry) {
  add_method<EkfSlam2d, EkfSlam2dParams>(registry, "ekf_slam_2d");
  add_method<GraphSlam2d, GraphSlamOptions>(registry, "graph_slam_2d");
  add_method<HectorSlam2d, HectorSlamParams>(registry, "hector_slam_2d");
  add_method<OdometrySlam2d, OdometrySlam2dParams>(registry, "odometry");
  add_method<ParticleSlam2d, ParticleSlamParams>(registry, "particle_slam_2d");
}

}  // namespace trident::slam
