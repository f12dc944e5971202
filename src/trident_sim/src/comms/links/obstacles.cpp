// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/links/obstacles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

#include "comms/phy/propagation.h"
#include "trident_base/angle.h"
#include "trident_sim/model.h"

namespace trident::sim {
namespace {

constexpr double kOpaque_db = 200.0;  // what the ground is gone through with
constexpr double kGrazing_db = 6.03;  // knife_edge_loss_db(0)
// Beyond a surface that was hit [m].
constexpr double kBeyond_m = 1e-4;
// Steepest slope at which a wave goes around something.
constexpr double kSteepest = 4.0;
// Of the steepest slope, down to 1e-6.
constexpr int kHalvings = 22;

Ray ray_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Ray ray;
  ray.p_world_origin = from;
  ray.t_max_m = (to - from).norm();
  ray.direction_world = (to - from) / std::max(ray.t_max_m, 1e-9);
  return ray;
}

bool is_ground(const World& world, const RayShape& shape) {
  const Model* model = world.find_model(shape.model);
  if (model == nullptr) return false;
  for (const LinkSpec& link : model->spec.links) {
    if (link.name != shape.link) continue;
    for (const CollisionSpec& collision : link.collisions) {
      if (collision.name != shape.name) continue;
      return std::holds_alternative<PlaneShape>(collision.shape) ||
             std::holds_alternative<HeightmapShape>(collision.shape);
    }
  }
  return false;
}

}  // namespace

double Obstacles::loss_db(const End& a, const End& b, double wavelength_m) {
  const Frame frame = frame_of(a, b);
  if (frame.distance_m < 1e-3) return 0.0;
  // By the shape's number; names are compared, as numbers change when models come and go.
  known_shapes_.resize(rays(world_, RayGeometry::kCollision).shapes().size());
  const Points points = path_points(a, b, frame, wavelength_m);
  // Each path has two legs, from either end to a point of the disc about the middle.
  Walk paths;
  walk(a, b, points, &paths);
  walk(b, a, points, &paths);
  const double sum_db = std::accumulate(paths.loss_db.begin(), paths.loss_db.end(), 0.0);
  if (sum_db == 0.0) return 0.0;
  const double through_db = sum_db / static_cast<double>(kPaths);
  if (paths.is_blocked_at_first) {
    return std::min(through_db, around_db(a, b, frame, wavelength_m));
  }
  // As an edge comes near from the side: nothing to grazing, by the share of the width it covers.
  const auto covered = std::count_if(paths.loss_db.begin(), paths.loss_db.end(),
                                     [](double loss_db) { return loss_db > 0.0; });
  const double share = static_cast<double>(covered) / static_cast<double>(kPaths);
  return std::min(through_db, kGrazing_db * std::min(2.0 * share, 1.0));
}

Obstacles::Frame Obstacles::frame_of(const End& a, const End& b) const {
  Frame frame;
  const Eigen::Vector3d path = b.p_world - a.p_world;
  frame.distance_m = path.norm();
  frame.along = path / std::max(frame.distance_m, 1e-9);
  const bool is_upright = std::abs(frame.along.z()) > 0.999;
  const Eigen::Vector3d helper = is_upright ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  frame.left = helper.cross(frame.along).normalized();
  frame.up = frame.along.cross(frame.left);
  return frame;
}

// Infinite where there is no ground below.
double Obstacles::height_over_ground(const End& end) const {
  Ray down;
  down.p_world_origin = end.p_world;
  down.direction_world = -Eigen::Vector3d::UnitZ();
  RayHit hit;
  RayFilter others;
  others.exclude_model = end.model;
  rays(world_, RayGeometry::kCollision).cast({&down, 1}, {&hit, 1}, nullptr, others);
  return hit.distance_m;
}

// The first is the straight path; the others fill a disc about its middle (Vogel's sunflower). What
// lies flat below both antennas is not in their path: its influence is that of the path's model.
Obstacles::Points Obstacles::path_points(const End& a, const End& b, const Frame& frame,
                                         double wavelength_m) const {
  constexpr double kOfFresnelZone = 0.6, kMin_m = 0.3, kOfHeight = 0.9;
  const double radius_m =
      std::max(kOfFresnelZone * std::sqrt(wavelength_m * frame.distance_m / 4.0), kMin_m);
  const double below_m =
      std::min(radius_m, kOfHeight * std::min(height_over_ground(a), height_over_ground(b)));
  const Eigen::Vector3d middle = 0.5 * (a.p_world + b.p_world);
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  Points points;
  for (std::size_t k = 0; k < kPaths; ++k) {
    const double r = radius_m * std::sqrt(static_cast<double>(k) / static_cast<double>(kPaths - 1));
    const double angle = golden * static_cast<double>(k);
    const double up_m = r * std::sin(angle) * (std::sin(angle) < 0.0 ? below_m / radius_m : 1.0);
    points[k] = middle + up_m * frame.up + r * std::cos(angle) * frame.left;
  }
  return points;
}

bool Obstacles::Walk::add(std::size_t path, std::uint32_t shape) {
  const auto begin = shapes[path].begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(count[path]);
  if (count[path] == kMaxShapes || std::find(begin, end, shape) != end) return false;
  shapes[path][count[path]++] = shape;
  return true;
}

// Adds up what is gone through from one end to the points, each shape once.
void Obstacles::walk(const End& from, const End& other, const Points& points, Walk* walk) {
  const RayScene& scene = rays(world_, RayGeometry::kCollision);
  std::array<Ray, kPaths> paths;
  for (std::size_t k = 0; k < kPaths; ++k) paths[k] = ray_between(from.p_world, points[k]);
  RayFilter others;
  others.exclude_model = from.model;
  std::array<RayHit, kPaths> hits;
  bool is_unfinished = true;
  for (std::size_t round = 0; is_unfinished && round < 2 * kMaxShapes; ++round) {
    scene.cast(Span<const Ray>(paths), Span<RayHit>(hits), nullptr, others);
    is_unfinished = false;
    for (std::size_t k = 0; k < kPaths; ++k) {
      if (!hits[k].is_hit()) continue;
      is_unfinished = true;
      paths[k].t_min_m = hits[k].distance_m + kBeyond_m;
      const bool is_other = scene.shapes()[hits[k].shape].model_address == other.model;
      if (is_other || !walk->add(k, hits[k].shape)) continue;
      walk->loss_db[k] = std::min(walk->loss_db[k] + shape_loss_db(hits[k].shape), kOpaque_db);
      if (k == 0) walk->is_blocked_at_first = true;
    }
  }
}

double Obstacles::shape_loss_db(std::uint32_t shape) {
  const RayShape& info = rays(world_, RayGeometry::kCollision).shapes()[shape];
  KnownShape& known = known_shapes_[shape];
  if (known.name != info.name || known.link != info.link || known.model != info.model) {
    known = {info.model, info.link, info.name, new_shape_loss_db(info)};
  }
  return known.loss_db;
}

double Obstacles::new_shape_loss_db(const RayShape& shape) const {
  const std::string name = shape.model + "::" + shape.link + "::" + shape.name;
  for (const auto& [part, loss_db] : params_.materials) {
    if (name.find(part) != std::string::npos) return loss_db;
  }
  return is_ground(world_, shape) ? kOpaque_db : params_.penetration_db;
}

// The lowest slopes at which a wave leaves an end, up, left and right, without hitting anything; by
// bisection. Infinite where even the steepest is blocked.
std::array<double, 3> Obstacles::least_slopes(const End& from, const End& other, const Frame& frame,
                                              double sign) {
  const RayScene& scene = rays(world_, RayGeometry::kCollision);
  RayFilter others;
  others.exclude_model = from.model;
  const std::array<Eigen::Vector3d, 3> sides{frame.up, frame.left, -frame.left};
  const auto are_blocked = [&](const std::array<double, 3>& slopes) {
    std::array<Ray, 3> paths;
    std::array<RayHit, 3> hits;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d path = frame.distance_m * (sign * frame.along + slopes[i] * sides[i]);
      paths[i] = ray_between(from.p_world, from.p_world + path);
    }
    scene.cast(Span<const Ray>(paths), Span<RayHit>(hits), nullptr, others);
    std::array<bool, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = hits[i].is_hit() && scene.shapes()[hits[i].shape].model_address != other.model;
    }
    return result;
  };
  std::array<double, 3> low{}, high{kSteepest, kSteepest, kSteepest};
  const std::array<bool, 3> is_closed = are_blocked(high);
  for (int n = 0; n < kHalvings; ++n) {
    std::array<double, 3> middle;
    for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * (low[i] + high[i]);
    const std::array<bool, 3> is_blocked = are_blocked(middle);
    for (std::size_t i = 0; i < 3; ++i) (is_blocked[i] ? low : high)[i] = middle[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_closed[i]) high[i] = std::numeric_limits<double>::infinity();
  }
  return high;
}

// Over the edge where the lowest free paths from both ends intersect.
double Obstacles::around_db(const End& a, const End& b, const Frame& frame, double wavelength_m) {
  const std::array<double, 3> from_a = least_slopes(a, b, frame, 1.0);
  const std::array<double, 3> from_b = least_slopes(b, a, frame, -1.0);
  double least_db = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const double sum = from_a[i] + from_b[i];
    if (!std::isfinite(sum) || sum <= 0.0) continue;
    // The edge is at the distance d1 from a where both slopes reach one height.
    const double d1_m = std::clamp(frame.distance_m * from_b[i] / sum, 1e-3,
                                   frame.distance_m - 1e-3 * frame.distance_m);
    const double v =
        diffraction_parameter(from_a[i] * d1_m, d1_m, frame.distance_m - d1_m, wavelength_m);
    least_db = std::min(least_db, knife_edge_loss_db(v));
  }
  return least_db;
}

}  // namespace trident::sim
