// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "box_world.h"

#include <cmath>
#include <ctime>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::sim {

ModelSpec make_model(const std::string& name, const Shape& shape, const SE3& T_world_model,
                     bool is_static) {
  ModelSpec model;
  model.name = name;
  model.T_world_model = T_world_model;
  model.is_static = is_static;
  model.links.emplace_back();
  model.links.back().name = "link";
  CollisionSpec collision;
  collision.name = "collision";
  collision.shape = shape;
  model.links.back().collisions.push_back(collision);
  return model;
}

void add_boxes(World& world, bool is_static) {
  world.spawn(make_model("ground", PlaneShape{Eigen::Vector3d::UnitZ()}, {}, true), "");
  const RandomStream stream(1, "ray_benchmark");
  std::uint64_t draw = 0;
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * stream.uniform(draw++, 0);
  };
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d size(uniform(0.4, 2.0), uniform(0.4, 2.0), uniform(0.4, 2.0));
    const double range = uniform(3.0, 20.0), bearing = uniform(-kPi, kPi);
    const Eigen::Vector3d p(range * std::cos(bearing), range * std::sin(bearing), 0.5 * size.z());
    world.spawn(make_model("box" + std::to_string(i), BoxShape{size},
                           SE3::from_xyz_rpy(p, 0.0, 0.0, uniform(-kPi, kPi)), is_static),
                "");
  }
}

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace trident::sim
