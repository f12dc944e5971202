// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Materials and pictures of visual scenes.
#include <sstream>

#include "ray_content.h"
#include "trident_base/error.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// A visual's own material counts for the whole of it; else the mesh's.
void RayScene::Content::add_material(TracedShape& shape) {
  shape.material = static_cast<std::uint32_t>(tables_.materials.size());
  shape.has_mesh_materials = shape.mesh != nullptr && !shape.visual->material.is_given &&
                             !shape.mesh->triangle_materials.empty();
  if (shape.has_mesh_materials) {
    const std::vector<Material>& own = shape.mesh->materials;
    tables_.materials.insert(tables_.materials.end(), own.begin(), own.end());
  } else {
    tables_.materials.push_back(shape.visual->material);
  }
}

void RayScene::Content::use_textures() {
  if (textures_.are_used) return;
  textures_.are_used = true;
  find_textures();
}

void RayScene::Content::find_textures() {
  textures_.by_material.assign(tables_.materials.size(), nullptr);
  if (!textures_.are_used) return;
  for (std::size_t i = 0; i < tables_.materials.size(); ++i) {
    if (!tables_.materials[i].texture_file.empty())
      textures_.by_material[i] = find_texture(tables_.materials[i]);
  }
}

const Texture* RayScene::Content::find_texture(const Material& material) {
  const auto known = textures_.by_file.find(material.texture_file);
  if (known != textures_.by_file.end()) return known->second.get();
  std::unique_ptr<Texture>& texture = textures_.by_file[material.texture_file];
  try {
    texture = std::make_unique<Texture>(read_texture(material.texture_file));
  } catch (const Error& error) {
    std::ostringstream text;
    text << error.what() << "; cameras see the colour (" << material.diffuse.head<3>().transpose()
         << ") instead";
    world_.report(Severity::kWarning, text.str());
  }
  return texture.get();
}

Eigen::Vector3d RayScene::Content::albedo(const RayHit& hit) const {
  if (hit.material >= tables_.materials.size()) return Eigen::Vector3d::Zero();
  if (const Texture* const texture = textures_.by_material[hit.material])
    return texture->at(hit.uv).cast<double>();
  return tables_.materials[hit.material].diffuse.head<3>();
}

double RayScene::Content::intensity(const RayHit& hit) const {
  if (!hit.is_hit()) return 0.0;
  if (const auto& retro = tables_.shapes[hit.shape].laser_retro) return *retro;
  if (hit.material >= tables_.materials.size()) return 0.0;
  constexpr double kRed = 0.2126, kGreen = 0.7152, kBlue = 0.0722;  // ITU-R BT.709
  const Eigen::Vector4d& color = tables_.materials[hit.material].diffuse;
  return 100.0 * (kRed * color[0] + kGreen * color[1] + kBlue * color[2]);
}

}  // namespace trident::sim
