// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analytic_surface.h"
#include "embree.h"
#include "moving_parts.h"
#include "ray_packet.h"
#include "textures/texture.h"
#include "trident_sim/model.h"
#include "trident_sim/ray_scene.h"

namespace trident::sim {

/// A link as rays know it.
struct TracedLink {
  const Link* link = nullptr;
  SE3 T_world_link;
  bool moves = false;
  std::vector<std::unique_ptr<TracedShape>> shapes;
  EmbreeScene scene;  ///< of a moving link: of its shapes but planes; nullptr without any
  std::optional<std::size_t> part;  ///< number of that among what moves
};

struct TracedModel {
  const Model* model = nullptr;
  std::uint64_t spawn_number = 0;
  std::vector<TracedLink> links;
};

/// A plane where it lies now. Planes are intersected without Embree, which knows nothing infinite.
struct PlacedPlane {
  const TracedShape* shape;
  FlatSurface surface;
};

/// What RayScene holds: shapes, Embree's scenes, and tables that lead from Embree's numbers back.
class RayScene::Content {
 public:
  Content(const World& world, RayGeometry kind,
          std::shared_ptr<AnalyticSurfaceSource> surface_source);
  ~Content();

  void refresh();
  std::shared_ptr<const AnalyticSurface> refresh_surface(const Eigen::Vector3d& p_world_viewer);
  double surface_ceiling_m();
  const AnalyticSurface* surface() const { return surface_.now.get(); }
  std::uint32_t surface_shape() const { return surface_.shape; }
  void add_surface(const AnalyticSurface& surface, Span<const Ray> rays, Span<RayHit> hits) const;
  void use_textures();
  Eigen::Vector3d albedo(const RayHit& hit) const;
  double intensity(const RayHit& hit) const;
  void cast_packet(const Ray* rays, RayHit* hits, std::size_t count, const RayFilter& filter) const;
  void occlude_packet(const Ray* rays, bool* result, std::size_t count,
                      const RayFilter& filter) const;

  void intersect_packet(const RayPacket& rays, PacketHits& hits, std::uint32_t mask) const;
  std::uint32_t shaded_lanes(const RayPacket& rays, std::uint32_t mask) const;
  SurfaceLook look(std::uint32_t shape, std::uint32_t primitive) const;
  SurfacePoint look_at(std::uint32_t shape, std::uint32_t primitive, const Ray& ray,
                       double t) const;

  RayGeometry geometry() const { return geometry_; }
  const std::vector<RayShape>& shapes() const { return tables_.shapes; }
  const std::vector<Material>& materials() const { return tables_.materials; }
  const Commits& commits() const { return commits_; }

 private:
  // Following the world: ray_content.cpp, materials: ray_look.cpp
  void forget_gone_models();
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

  // The analytic surface: ray_surface.cpp
  void number_surface(std::uint32_t models, std::uint32_t links);

  // Casting: ray_cast.cpp
  const TracedShape* nearest_plane(const Ray& ray, const RayFilter& filter, bool shadows_only,
                                   double& t) const;
  const TracedShape& shape_hit(std::uint32_t instance, std::uint32_t geometry_number) const;
  void add_look(const Ray& ray, const TracedShape& shape, std::uint32_t primitive,
                RayHit& hit) const;
  RayHit describe(const Ray& ray, const TracedShape& shape, std::uint32_t primitive,
                  double t) const;

  /// What indices of hits count in.
  struct Tables {
    std::vector<RayShape> shapes;
    std::vector<const TracedShape*> traced;  ///< by TracedShape::index
    std::vector<Material> materials;
    bool some_cast_no_shadow = false;
  };
  /// What the next refresh() has to make again.
  struct Changes {
    bool models = false, fixed = false;
    bool parts = false, places = false;  ///< of what moves
  };
  struct Textures {
    bool are_used = false;
    std::map<std::string, std::unique_ptr<Texture>> by_file;  ///< nullptr: cannot be read
    std::vector<const Texture*> by_material;                  ///< nullptr: none
  };
  /// What never moves.
  struct Fixed {
    EmbreeScene scene;  ///< nullptr: empty
    bool has_triangles = false;
    std::vector<const TracedShape*> shapes;  ///< by geomID
  };
  /// The analytic surface.
  struct Surface {
    std::shared_ptr<AnalyticSurfaceSource> source;  ///< nullptr: the world has none
    std::shared_ptr<const AnalyticSurface> now;     ///< nullptr: not asked for since refresh()
    bool has_shape = false;
    std::uint32_t shape = RayHit::kNothing;
    std::uint32_t material = RayHit::kNothing;
  };

  const World& world_;
  const RayGeometry geometry_;
  Tables tables_;
  Commits commits_;
  EmbreeDevice device_;  ///< goes after all that is made with it
  std::map<std::string, TracedModel> models_;
  std::optional<std::uint64_t> seen_models_;  ///< World::models_version()
  std::map<std::string, std::weak_ptr<const TriangleMesh>> meshes_;
  Textures textures_;
  Changes changed_;
  Fixed fixed_;
  MovingParts moving_;
  std::vector<PlacedPlane> planes_;
  std::vector<std::vector<const TracedShape*>> part_shapes_;  ///< by part, then geomID
  Surface surface_;
};

}  // namespace trident::sim
