// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "trident_sim/ray_scene.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// What things in the path of a radio wave do to it.
struct ObstacleParams {
  double penetration_db = 12.0;  ///< of one collision shape that the wave goes through
  /// A part of a collision's scoped name, and the loss by such a one; the first that fits counts.
  std::vector<std::pair<std::string, double>> materials;
};

/// Loss by the ground and by things between two antennas. A wave goes through what is in its path,
/// each shape with its penetration loss, or around it, above, left or right, over the edge that
/// Bullington's construction makes of all obstacles (ITU-R P.526, 4.5.1); what costs less counts.
/// The ground, planes and heightmaps, cannot be gone through.
///
/// Penetration is the mean over 64 paths that fill 0.6 of the first Fresnel zone, so that it
/// comes on as the wave's width passes an edge, and has no steps.
class Obstacles {
 public:
  /// An antenna and the model that carries it, which is not in its own path.
  struct End {
    Eigen::Vector3d p_world;
    const Model* model = nullptr;
  };
  /// `world` must outlive it.
  Obstacles(World& world, ObstacleParams params) : world_(world), params_(std::move(params)) {}

  /// [dB]. The scene must be fresh (RayScene::refresh()).
  double loss_db(const End& a, const End& b, double wavelength_m);

 private:
  static constexpr std::size_t kPaths = 4 * RayScene::kPacket;
  using Points = std::array<Eigen::Vector3d, kPaths>;
  static constexpr std::size_t kMaxShapes = 12;  ///< on one path
  struct Walk {
    std::array<double, kPaths> loss_db{};                              ///< of each path
    std::array<std::array<std::uint32_t, kMaxShapes>, kPaths> shapes;  ///< that it goes through
    std::array<std::size_t, kPaths> count{};                           ///< of them

    /// False: the path goes through it already, or through so many that no more matter.
    bool add(std::size_t path, std::uint32_t shape);
    bool is_blocked_at_first = false;  ///< of the straight path
  };
  /// Directions across the straight path: up, and to the left.
  struct Frame {
    Eigen::Vector3d along, up, left;
    double distance_m = 0.0;
  };

  Frame frame_of(const End& a, const End& b) const;
  double height_over_ground(const End& end) const;
  Points path_points(const End& a, const End& b, const Frame& frame, double wavelength_m) const;
  void walk(const End& from, const End& other, const Points& points, Walk* walk);
  double shape_loss_db(std::uint32_t shape);
  double new_shape_loss_db(const RayShape& shape) const;
  double around_db(const End& a, const End& b, const Frame& frame, double wavelength_m);
  std::array<double, 3> least_slopes(const End& from, const End& other, const Frame& frame,
                                     double sign);

  World& world_;
  ObstacleParams params_;
  /// Of a shape of the scene, as long as it has that name.
  struct KnownShape {
    std::string model, link, name;
    double loss_db = 0.0;
  };
  std::vector<KnownShape> known_shapes_;  ///< by the scene's shapes
};

}  // namespace trident::sim
