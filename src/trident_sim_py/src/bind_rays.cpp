// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Rays through the world, many at a time.
#include <pybind11/stl.h>

#include <limits>
#include <vector>

#include "bindings.h"
#include "convert.h"
#include "session.h"
#include "trident_base/error.h"
#include "trident_sim/ray_scene.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

/// Directions shorter than this have none.
constexpr double kShortest = 1e-12;

std::vector<Ray> to_rays(const NumpyArray& origins, const NumpyArray& directions, double t_max) {
  const auto from = origins.unchecked<2>();
  const auto towards = directions.unchecked<2>();
  std::vector<Ray> rays(static_cast<std::size_t>(from.shape(0)));
  for (py::ssize_t i = 0; i < from.shape(0); ++i) {
    Ray& ray = rays[static_cast<std::size_t>(i)];
    ray.p_world_origin = {from(i, 0), from(i, 1), from(i, 2)};
    const Eigen::Vector3d direction(towards(i, 0), towards(i, 1), towards(i, 2));
    const double length = direction.norm();
    if (!(length > kShortest)) {
      throw Error("directions[" + std::to_string(i) + "] has no length, legal: more than 1e-12");
    }
    // Unit length, so that the distance of a hit is in meters.
    ray.direction_world = direction / length;
    ray.t_max_m = t_max;
  }
  return rays;
}

NumpyArray rows_of_three(const py::object& value, const std::string& what) {
  NumpyArray array = to_array(value, what, 2);
  if (array.shape(1) != 3) {
    throw Error(what + " has shape (" + std::to_string(array.shape(0)) + ", " +
                std::to_string(array.shape(1)) + "), legal: (n, 3)");
  }
  return array;
}

py::tuple to_arrays(const std::vector<RayHit>& hits) {
  const auto count = static_cast<py::ssize_t>(hits.size());
  py::array_t<double> distance(count), normal({count, py::ssize_t{3}});
  py::array_t<std::int64_t> shape(count);
  auto distances = distance.mutable_unchecked<1>();
  auto normals = normal.mutable_unchecked<2>();
  auto shapes = shape.mutable_unchecked<1>();
  for (py::ssize_t i = 0; i < count; ++i) {
    const RayHit& hit = hits[static_cast<std::size_t>(i)];
    distances(i) = hit.distance_m;
    shapes(i) = hit.is_hit() ? static_cast<std::int64_t>(hit.shape) : -1;
    for (py::ssize_t k = 0; k < 3; ++k) normals(i, k) = hit.normal_world[k];
  }
  return py::make_tuple(distance, normal, shape);
}

/// Distances, normals and indices of the shapes hit, one per ray.
py::tuple cast_rays(Session& session, const py::object& origins, const py::object& directions,
                    double t_max, bool is_visual) {
  const NumpyArray from = rows_of_three(origins, "origins");
  const NumpyArray towards = rows_of_three(directions, "directions");
  if (from.shape(0) != towards.shape(0)) {
    throw Error("directions has " + std::to_string(towards.shape(0)) +
                " rows, legal: " + std::to_string(from.shape(0)) + ", as origins has");
  }
  if (!(t_max > 0.0)) {
    throw Error("max_distance is " + std::to_string(t_max) + " m, legal: more than 0");
  }
  const std::vector<Ray> rays = to_rays(from, towards, t_max);
  std::vector<RayHit> hits(rays.size());
  RayScene& scene =
      sim::rays(session.world(), is_visual ? RayGeometry::kVisual : RayGeometry::kCollision);
  scene.refresh();
  // Waves are drawn about one place; that of the first ray stands for all.
  if (!rays.empty()) scene.refresh_surface(rays.front().p_world_origin);
  scene.cast({rays.data(), rays.size()}, {hits.data(), hits.size()});
  return to_arrays(hits);
}

/// Model, link and name of each shape.
std::vector<std::tuple<std::string, std::string, std::string>> ray_shapes(Session& session,
                                                                          bool is_visual) {
  RayScene& scene =
      sim::rays(session.world(), is_visual ? RayGeometry::kVisual : RayGeometry::kCollision);
  scene.refresh();
  std::vector<std::tuple<std::string, std::string, std::string>> result;
  for (const RayShape& shape : scene.shapes()) {
    result.emplace_back(shape.model, shape.link, shape.name);
  }
  return result;
}

}  // namespace

void bind_rays(py::module_& module) {
  module.def("cast_rays", &cast_rays, py::arg("session"), py::arg("origins"), py::arg("directions"),
             py::arg("max_distance"), py::arg("visual"),
             "Distances, normals and shape indices; see World.cast_rays.");
  module.def("ray_shapes", &ray_shapes, py::arg("session"), py::arg("visual"),
             "(model, link, name) of each shape that rays can hit.");
}

}  // namespace trident::sim
