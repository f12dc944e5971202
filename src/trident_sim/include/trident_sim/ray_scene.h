// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/span.h"
#include "trident_sim/model_spec.h"

namespace trident::sim {

class AnalyticSurface;
class AnalyticSurfaceSource;
class Model;
class PacketRays;
class World;
struct Link;

/// What rays hit: collision shapes (`ray` sensors) or visual shapes (`gpu_ray`, cameras).
enum class RayGeometry { kCollision, kVisual };

/// A half-line, or a part of one, along which something is looked for.
struct Ray {
  Eigen::Vector3d p_world_origin = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d direction_world = Eigen::Vector3d::UnitX();  ///< of unit length
  double t_min_m = 0.0;                                        ///< what is nearer is not hit
  double t_max_m = std::numeric_limits<double>::infinity();    ///< what is farther is not hit
};

/// The first surface that a ray hits.
struct RayHit {
  static constexpr std::uint32_t kNothing = 0xffffffff;  ///< no index

  double distance_m = std::numeric_limits<double>::infinity();  ///< infinite: nothing hit
  /// Of unit length, against the ray. Of a visual mesh with normals of its own those, interpolated.
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();
  std::uint32_t shape = kNothing;     ///< index into RayScene::shapes()
  std::uint32_t material = kNothing;  ///< index into RayScene::materials(), visual scenes only
  /// Texture coordinates, v upwards, visual scenes only: in [0, 1] over each face of a box and the
  /// hull of a round shape, metres on a plane, the file's own on a mesh.
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();

  /// Whether distance, normal and indices are valid.
  bool is_hit() const { return shape != kNothing; }
};

/// Which shapes a cast does not see. One for all its rays, as they come from one sensor.
struct RayFilter {
  std::uint32_t mask = 0xffffffff;       ///< seen is what has a bit of it in <visibility_flags>
  const Link* exclude_link = nullptr;    ///< whose shapes are not seen; nullptr: none
  const Model* exclude_model = nullptr;  ///< whose shapes are not seen; nullptr: none

  /// Whether shapes must be looked at one by one.
  bool excludes() const { return exclude_link != nullptr || exclude_model != nullptr; }
};

/// What a RayHit::shape stands for.
struct RayShape {
  std::string model, link, name;         ///< of the collision or visual
  std::uint32_t model_id = 0;            ///< number of the model, in name order
  std::uint32_t link_id = 0;             ///< number of the link, model by model
  const Model* model_address = nullptr;  ///< to compare with, alive or not
  const Link* link_address = nullptr;    ///< to compare with, alive or not
  std::optional<double> laser_retro;     ///< where its collision or visual has one
};

/// What a sensor has to cast within a step, deferred to the end of the phase, so that threads share
/// what all sensors have to cast there instead of the few rays of each. Its scene is refreshed
/// before begin(), and stays as it is until all parts are done.
class RayJob {
 public:
  virtual ~RayJob() = default;
  /// Where it looks from, world frame [m].
  virtual Eigen::Vector2d viewer() const = 0;
  /// Called by the stepping thread, in the order in which jobs were deferred. Returns the number of
  /// parts.
  virtual std::size_t begin() = 0;
  /// Called by any thread, once for each part; it writes only what belongs to the part.
  virtual void run_part(std::size_t part) = 0;
  /// Called as begin() is, after all parts of all jobs.
  virtual void finish() = 0;
};

/// Jobs of one phase of a step, in the order in which they were deferred.
class DeferredRayJobs {
 public:
  void add(RayJob& job) { jobs_.push_back(&job); }
  bool empty() const { return jobs_.empty(); }
  const std::vector<RayJob*>& jobs() const { return jobs_; }
  /// Forgets jobs that were done, or whose step ended with an error.
  void clear() { jobs_.clear(); }

 private:
  std::vector<RayJob*> jobs_;
};

/// The world as rays see it, by Embree. What never moves lies in one scene, which is committed
/// again when a part of it comes, goes or moves; every moving link has a scene of its own, which is
/// instanced. Embree counts in float and only reports which surface is hit; where, and how it
/// leans, is then worked out in double from the shape itself: ranges to boxes, spheres, cylinders,
/// capsules and planes are exact also far from the origin.
///
/// Planes are infinite and hit from both sides, like all surfaces. Visuals with transparency 1 or
/// alpha 0 are not there. A visual mesh that cannot be read is reported once and left out.
class RayScene {
 public:
  /// Sees nothing before the first refresh(). `world` must outlive the scene. `surface_source` is
  /// the world's analytic surface; nullptr: it has none.
  RayScene(const World& world, RayGeometry geometry,
           std::shared_ptr<AnalyticSurfaceSource> surface_source);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Follows the world: models that came and went, links that moved. Cheap when nothing did. Not to
  /// be called while another thread casts; hits from before lose their indices when models came or
  /// went.
  void refresh();
  /// Has cast() hit the world's analytic surface, the water of its sea, too, as it is now for a
  /// viewer there, until the next refresh(). It is a shape, the last one, is hit from both sides
  /// and hides what lies beyond. Returns that surface, which stays as it is; nullptr where none
  /// exists.
  std::shared_ptr<const AnalyticSurface> refresh_surface(const Eigen::Vector3d& p_world_viewer);
  /// No point of the analytic surface is higher now [m]; minus infinity where none exists. A caller
  /// whose rays all stay above it need not call refresh_surface(), which costs.
  double surface_ceiling_m();

  /// Casts each ray; hits.size() >= rays.size(). A ray with a component that is not finite hits
  /// nothing. Any number of threads may cast at the same time. Rays are cast in packets of
  /// kPacket: a result does not depend on threads as long as work is divided between packets.
  void cast(Span<const Ray> rays, Span<RayHit> hits, const RayFilter& filter = {}) const;
  /// The same with a surface that another refresh_surface() returned, of the same moment; nullptr:
  /// without.
  void cast(Span<const Ray> rays, Span<RayHit> hits, const AnalyticSurface* surface,
            const RayFilter& filter = {}) const;
  /// Puts the surface before what rays have hit without it.
  void add_surface(const AnalyticSurface& surface, Span<const Ray> rays, Span<RayHit> hits) const;
  /// Whether anything that casts shadows lies between t_min and t_max; faster than cast().
  void occluded(Span<const Ray> rays, Span<bool> result, const RayFilter& filter = {}) const;
  static constexpr std::size_t kPacket = 16;  ///< rays that Embree traces at once

  /// Has refresh() read the pictures of the materials from now on, of visual scenes. Cameras need
  /// them, lidars do not. A picture that cannot be read is reported once; only PNG can.
  void use_textures();
  /// Colour of what was hit, red, green, blue in [0, 1]: its picture's where it has one that was
  /// read, else its material's diffuse. Black: nothing was hit, or the scene is not visual.
  Eigen::Vector3d albedo(const RayHit& hit) const;
  /// How strongly a lidar sees what was hit: the shape's `<laser_retro>`; else, of a visual, 100
  /// times the luminance of its material's diffuse colour, of a collision 0. 0: nothing was hit.
  double intensity(const RayHit& hit) const;

  /// The analytic surface, which PacketRays leaves out; nullptr where refresh_surface() was not
  /// called, or none exists.
  const AnalyticSurface* surface() const;
  /// RayHit::shape of the analytic surface; RayHit::kNothing where none exists.
  std::uint32_t surface_shape() const;

  RayGeometry geometry() const;  ///< as constructed
  /// What RayHit::shape counts in. Valid until the next refresh().
  const std::vector<RayShape>& shapes() const;
  /// What RayHit::material counts in; of a collision scene empty. Valid until the next refresh().
  const std::vector<Material>& materials() const;

  /// What is to be cast at the end of the phase of the step that the world is in.
  DeferredRayJobs& deferred() { return deferred_; }

  /// How often what never moves, and the moving links' places, were committed.
  struct Commits {
    std::uint64_t fixed = 0, moving = 0;  ///< counts
  };
  /// Since the scene was made; tests see by it that what stands still costs nothing.
  Commits commits() const;

 private:
  friend class PacketRays;
  class Content;
  std::unique_ptr<Content> content_;
  DeferredRayJobs deferred_;
};

/// The scene of a world, which is made when it is first asked for. It follows the world when its
/// refresh() is called.
RayScene& rays(World& world, RayGeometry geometry);

}  // namespace trident::sim
