// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ray_content.h"

#include <algorithm>

#include "trident_base/error.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

/// For pictures boxes are triangles: in some worlds the others take them four times as
/// long.
BoxForm box_form(RayGeometry geometry) {
  return geometry == RayGeometry::kVisual ? BoxForm::kTriangles : BoxForm::kOwn;
}

bool same(const SE3& a, const SE3& b) { return a.p == b.p && a.R.coeffs() == b.R.coeffs(); }

bool visible(const VisualSpec& visual) {
  return visual.transparency < 1.0 &&
         !(visual.material.is_given && visual.material.diffuse.w() <= 0.0);
}

std::string numbers(const Eigen::Vector3d& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

}  // namespace

/// Follows the world in order of cost: models by a version number, links by their poses; what
/// nothing has changed is not committed again. Indices of shapes change only when models come or
/// go.
void RayScene::Content::refresh() {
  if (device_ == nullptr) device_ = make_device();
  surface_.now.reset();
  follow_models();
  follow_links();
  if (changed_.models) {
    number();
    find_textures();
  }
  for (PlacedPlane& plane : planes_) plane.surface = flat_surface(*plane.shape, 0);
  if (changed_.fixed) commit_fixed();
  if (changed_.parts) {
    attach_parts();
  } else if (changed_.places) {
    commit_moving();
  }
  changed_.models = changed_.fixed = changed_.parts = changed_.places = false;
}

void RayScene::Content::note_change(const TracedModel& traced) {
  changed_.models = true;
  for (const TracedLink& link : traced.links) {
    if (link.shapes.empty()) continue;
    (link.moves ? changed_.parts : changed_.fixed) = true;
  }
}

/// Another one of the same name counts as gone, too.
void RayScene::Content::forget_gone_models() {
  for (auto it = models_.begin(); it != models_.end();) {
    const Model* const alive = world_.find_model(it->first);
    if (alive != nullptr && alive->spawn_number == it->second.spawn_number) {
      ++it;
      continue;
    }
    note_change(it->second);
    it = models_.erase(it);
  }
}

void RayScene::Content::follow_models() {
  if (seen_models_ == world_.models_version()) return;
  seen_models_ = world_.models_version();
  forget_gone_models();
  if (models_.size() == world_.models().size()) return;
  for (const auto& [name, model] : world_.models()) {
    if (models_.count(name) == 0) note_change(models_.emplace(name, trace(*model)).first->second);
  }
}

TracedModel RayScene::Content::trace(const Model& model) {
  TracedModel traced{&model, model.spawn_number, {}};
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    TracedLink link;
    link.link = model.links[i].get();
    link.moves = link.link->body != nullptr;
    link.T_world_link = link.link->T_world_link();
    add_shapes(model, model.spec.links[i], link);
    set_places(link);
    if (link.moves) make_part(link);
    traced.links.push_back(std::move(link));
  }
  return traced;
}

void RayScene::Content::add_shapes(const Model& model, const LinkSpec& spec, TracedLink& link) {
  const auto add = [&](const auto& part) {
    std::unique_ptr<TracedShape> shape =
        trace_shape(part.shape, model.name + "::" + spec.name + "::" + part.name);
    if (shape == nullptr) return;
    shape->name = part.name;
    shape->laser_retro = part.laser_retro;
    shape->T_link_shape = part.T_link_shape;
    shape->model = &model;
    shape->link = link.link;
    link.shapes.push_back(std::move(shape));
  };
  if (geometry_ == RayGeometry::kCollision) {
    for (const CollisionSpec& collision : spec.collisions) add(collision);
    return;
  }
  for (const VisualSpec& visual : spec.visuals) {
    const std::size_t before = link.shapes.size();
    if (visible(visual)) add(visual);
    if (link.shapes.size() == before) continue;
    link.shapes.back()->visual = &visual;
    link.shapes.back()->mask = visual.visibility_flags;
    link.shapes.back()->casts_shadows = visual.casts_shadows;
  }
}

/// A file that physics has read may still be unreadable as a picture or visual mesh: sensors then
/// do without that shape, and the world continues.
std::unique_ptr<TracedShape> RayScene::Content::trace_shape(const Shape& shape,
                                                            const std::string& what) {
  try {
    return std::make_unique<TracedShape>(make_traced_shape(shape, find_mesh(shape)));
  } catch (const Error& error) {
    const bool is_visual = geometry_ == RayGeometry::kVisual;
    world_.report(Severity::kWarning, std::string(is_visual ? "visual '" : "collision '") + what +
                                          "': " + error.what() + "; sensors do not see it");
    return nullptr;
  }
}

/// Shapes of one file and size share a mesh. nullptr: the shape is neither mesh nor heightmap.
std::shared_ptr<const TriangleMesh> RayScene::Content::find_mesh(const Shape& shape) {
  const auto* const mesh = std::get_if<MeshShape>(&shape);
  const auto* const heightmap = std::get_if<HeightmapShape>(&shape);
  if (mesh == nullptr && heightmap == nullptr) return nullptr;
  const std::string key = mesh != nullptr ? mesh->file + "\nmesh " + numbers(mesh->scale)
                                          : heightmap->file + "\nmap " + numbers(heightmap->size);
  std::weak_ptr<const TriangleMesh>& known = meshes_[key];
  if (auto alive = known.lock()) return alive;
  const MeshDetail detail =
      geometry_ == RayGeometry::kVisual ? MeshDetail::kLook : MeshDetail::kShape;
  auto read = std::make_shared<const TriangleMesh>(
      mesh != nullptr ? read_mesh(*mesh, detail) : read_heightmap(*heightmap, detail));
  known = read;
  return read;
}

/// Shapes of a moving link are attached in the link's frame, since its scene is instanced; those of
/// a static one in the world's. Normals and exact distances are always worked out in the world.
void RayScene::Content::set_places(TracedLink& link) {
  for (const auto& shape : link.shapes) {
    const SE3 T_world_shape = link.T_world_link * shape->T_link_shape;
    shape->R_world_shape = T_world_shape.R.normalized().toRotationMatrix();
    shape->p_world_shape = T_world_shape.p;
    const SE3& T_scene_shape = link.moves ? shape->T_link_shape : T_world_shape;
    shape->R_scene_shape = T_scene_shape.R.normalized().toRotationMatrix();
    shape->p_scene_shape = T_scene_shape.p;
  }
}

/// Planes are infinite, which Embree has no primitive for: they are intersected analytically.
void RayScene::Content::make_part(TracedLink& link) {
  for (const auto& shape : link.shapes) {
    if (shape->kind == SurfaceKind::kPlane) continue;
    if (link.scene == nullptr) link.scene = make_scene(device_.get(), SceneUse::kFixed);
    attach_shape(device_.get(), link.scene.get(), *shape, box_form(geometry_));
  }
  if (link.scene != nullptr) rtcCommitScene(link.scene.get());
}

void RayScene::Content::follow_links() {
  for (auto& [name, model] : models_) {
    for (TracedLink& link : model.links) {
      if (link.shapes.empty()) continue;
      const SE3 T_world_link = link.link->T_world_link();
      if (same(T_world_link, link.T_world_link)) continue;
      link.T_world_link = T_world_link;
      set_places(link);
      if (!link.moves) changed_.fixed = true;
      if (!link.part) continue;
      moving_.place(*link.part, T_world_link);
      changed_.places = true;
    }
  }
}

void RayScene::Content::number() {
  tables_.shapes.clear();
  tables_.traced.clear();
  tables_.materials.clear();
  planes_.clear();
  tables_.some_cast_no_shadow = false;
  // In order of the models' names, so that labels do not depend on who was spawned first.
  std::uint32_t model_id = 0, link_id = 0;
  for (auto& [model_name, model] : models_) {
    for (TracedLink& link : model.links) {
      for (const auto& shape : link.shapes) {
        shape->index = static_cast<std::uint32_t>(tables_.shapes.size());
        tables_.traced.push_back(shape.get());
        tables_.shapes.push_back({model_name, link.link->name, shape->name, model_id, link_id,
                                  model.model, link.link, shape->laser_retro});
        if (shape->visual != nullptr) add_material(*shape);
        if (shape->kind == SurfaceKind::kPlane)
          planes_.push_back({shape.get(), flat_surface(*shape, 0)});
        tables_.some_cast_no_shadow = tables_.some_cast_no_shadow || !shape->casts_shadows;
      }
      ++link_id;
    }
    ++model_id;
  }
  number_surface(model_id, link_id);
}

/// One scene for all that stands still; it is built again only when a part of it changed.
void RayScene::Content::commit_fixed() {
  fixed_.scene.reset();
  fixed_.shapes.clear();
  fixed_.has_triangles = geometry_ == RayGeometry::kVisual;
  for (const auto& [name, model] : models_) {
    for (const TracedLink& link : model.links) {
      if (link.moves) continue;
      for (const auto& shape : link.shapes) {
        if (shape->kind == SurfaceKind::kPlane) continue;
        if (fixed_.scene == nullptr) fixed_.scene = make_scene(device_.get(), SceneUse::kFixed);
        attach_shape(device_.get(), fixed_.scene.get(), *shape, box_form(geometry_));
        fixed_.shapes.push_back(shape.get());
        fixed_.has_triangles |= shape->kind == SurfaceKind::kMesh;
      }
    }
  }
  if (fixed_.scene != nullptr) rtcCommitScene(fixed_.scene.get());
  ++commits_.fixed;
}

void RayScene::Content::attach_parts() {
  moving_.clear();
  part_shapes_.clear();
  for (auto& [name, model] : models_) {
    for (TracedLink& link : model.links) {
      link.part.reset();
      if (link.scene == nullptr) continue;
      link.part = moving_.add(link.scene.get(), link.T_world_link);
      part_shapes_.emplace_back();
      for (const auto& shape : link.shapes) {
        if (shape->kind != SurfaceKind::kPlane) part_shapes_.back().push_back(shape.get());
      }
    }
  }
  commit_moving();
}

void RayScene::Content::commit_moving() {
  ++commits_.moving;
  moving_.commit(device_.get());
}

}  // namespace trident::sim
