// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "embree.h"
#include "moving_parts.h"
#include "ray_packet.h"
#include "texture.h"
#include "trident_sim/model.h"
#include "trident_sim/ray_scene.h"

namespace trident::sim {

class WaterTiles;

/// A link as rays know it.
struct TracedLink {
  const Link* link = nullptr;
  SE3 T_world_link;
  bool moves = false;
  std::vector<std::unique_ptr<TracedShape>> shapes;
  EmbreeScene scene;  ///< of a moving link: of its shapes but planes; nullptr: there are none
  std::optional<std::size_t> part;  ///< number of that among what moves
};

struct TracedModel {
  const Model* model = nullptr;
  std::uint64_t spawn_number = 0;
  std::vector<TracedLink> links;
};

/// A plane where it lies now. Planes are met without Embree, which knows nothing infinite.
struct PlacedPlane {
  const TracedShape* shape;
  FlatSurface surface;
};

/// What RayScene holds: shapes, Embree's scenes, and tables that lead from Embree's numbers back.
class RayScene::Content {
 public:
  Content(const World& world, RayGeometry kind, std::shared_ptr<WaterTiles> tiles);
  ~Content();

  void refresh();
  std::shared_ptr<const WaterSurface> refresh_water(const Eigen::Vector3d& p_world_viewer);
  double water_ceiling_m();
  const WaterSurface* water() const { return water_.get(); }
  const std::shared_ptr<WaterTiles>& tiles() const { return tiles_; }
  void add_water(const WaterSurface& water, Span<const Ray> rays, Span<RayHit> hits) const;
  void use_textures();
  Eigen::Vector3d albedo(const RayHit& hit) const;
  double intensity(const RayHit& hit) const;
  void cast_packet(const Ray* rays, RayHit* hits, std::size_t count, const RayFilter& filter) const;
  void occlude_packet(const Ray* rays, bool* result, std::size_t count,
                      const RayFilter& filter) const;

  void meet_packet(const RayPacket& rays, PacketHits& hits, std::uint32_t mask) const;
  std::uint32_t shaded_lanes(const RayPacket& rays, std::uint32_t mask) const;
  SurfaceLook look(std::uint32_t shape, std::uint32_t primitive) const;
  SurfacePoint look_at(std::uint32_t shape, std::uint32_t primitive, const Ray& ray,
                       double t) const;

  const RayGeometry geometry;
  std::vector<RayShape> shapes;
  std::vector<Material> materials;
  std::uint32_t water_shape = RayHit::kNothing;
  Commits commits;
  std::vector<RayWork*> put_off;
  std::vector<Eigen::Vector2d> viewers;                         ///< of works
  std::vector<RayWork*> works;                                  ///< those that are being done, and
  std::vector<std::pair<RayWork*, std::size_t>> put_off_parts;  ///< their parts

 private:
  // Following the world: ray_content.cpp, materials: ray_look.cpp
  void follow_models();
  void follow_links();
  void note_change(const TracedModel& traced);
  TracedModel trace(const Model& model);
  void add_shapes(const Model& model, const LinkSpec& spec, TracedLink& link);
  std::unique_ptr<TracedShape> trace_shape(const Shape& shape, const std::string& what);
  std::shared_ptr<const TriangleMesh> find_mesh(const Shape& shape);
  static void set_places(TracedLink& link);
  void make_part(TracedLink& link);
  void number();
  void add_material(TracedShape& shape);
  void find_textures();
  const Texture* find_texture(const Material& material);
  void commit_fixed();
  void attach_parts();
  void commit_moving();

  // The sea: water_cast.cpp
  void number_water(std::uint32_t models, std::uint32_t links);

  // Casting: ray_cast.cpp
  const TracedShape* nearest_plane(const Ray& ray, const RayFilter& filter, bool shadows_only,
                                   double& t) const;
  const TracedShape& shape_met(std::uint32_t instance, std::uint32_t geometry_number) const;
  void add_look(const Ray& ray, const TracedShape& shape, std::uint32_t primitive,
                RayHit& hit) const;
  RayHit describe(const Ray& ray, const TracedShape& shape, std::uint32_t primitive,
                  double t) const;

  const World& world_;
  EmbreeDevice device_;  ///< goes after all that is made with it
  std::map<std::string, TracedModel> models_;
  std::optional<std::uint64_t> seen_models_;  ///< World::models_version()
  std::map<std::string, std::weak_ptr<const TriangleMesh>> meshes_;
  bool use_textures_ = false;
  std::map<std::string, std::unique_ptr<Texture>> textures_;  ///< nullptr: cannot be read
  std::vector<const Texture*> material_textures_;             ///< by material; nullptr: none
  bool models_changed_ = false, fixed_changed_ = false;
  bool parts_changed_ = false, parts_moved_ = false;

  EmbreeScene fixed_;  ///< nullptr: empty
  bool fixed_has_triangles_ = false;
  MovingParts moving_;
  std::vector<PlacedPlane> planes_;
  std::vector<const TracedShape*> fixed_shapes_;              ///< by geomID
  std::vector<std::vector<const TracedShape*>> part_shapes_;  ///< by part, then geomID
  std::vector<const TracedShape*> traced_shapes_;             ///< by TracedShape::index
  bool some_cast_no_shadow_ = false;

  std::shared_ptr<WaterTiles> tiles_;
  std::shared_ptr<const WaterSurface> water_;            ///< nullptr: not asked for since refresh()
  std::vector<std::shared_ptr<WaterSurface>> surfaces_;  ///< some of which nobody looks at any more
  bool has_water_shape_ = false;
  std::uint32_t water_material_ = RayHit::kNothing;
};

}  // namespace trident::sim
