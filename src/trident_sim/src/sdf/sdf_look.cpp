// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_look.h"

#include <algorithm>

#include "ogre_materials.h"
#include "sdf_values.h"
#include "trident_base/error.h"

namespace trident {
namespace {

/// Components beyond [0, 1] are brought into it; libsdformat has warned of them.
Eigen::Vector4d to_rgba(const ignition::math::Color& color) {
  const Eigen::Vector4d rgba(color.R(), color.G(), color.B(), color.A());
  return rgba.cwiseMax(0.0).cwiseMin(1.0);
}

void read_color(const sdf::ElementPtr& material, const char* name, Eigen::Vector4d& color) {
  if (material->HasElement(name)) color = to_rgba(material->Get<ignition::math::Color>(name));
}

/// A script's name stands for its colours; colours beside it count where it is unknown.
void read_script(const sdf::ElementPtr& element, const std::string& what,
                 const ConvertContext& context, Material& material) {
  material.script = value_or(element, {"script", "name"}, std::string());
  if (material.script.empty() || material.script == "__default__") return;
  if (const OgreMaterial* known = find_ogre_material(material.script)) {
    material.ambient = known->ambient;
    material.diffuse = known->diffuse;
  } else if (!element->HasElement("diffuse")) {
    context.warn(context.label + ": " + what + ": material script '" + material.script +
                 "' is not known by its name; shown in grey");
  }
}

void read_texture(const sdf::ElementPtr& element, const std::string& what,
                  const ConvertContext& context, Material& material) {
  const auto uri = value_or(element, {"pbr", "metal", "albedo_map"}, std::string());
  if (uri.empty()) return;
  material.texture_file = context.resources.find(uri, context.base_folder);
  if (material.texture_file.empty()) {
    context.warn(context.label + ": " + what + ": texture '" + uri +
                 "' not found; shown without it");
  }
}

LightType light_type(sdf::LightType type) {
  switch (type) {
    case sdf::LightType::DIRECTIONAL:
      return LightType::kDirectional;
    case sdf::LightType::SPOT:
      return LightType::kSpot;
    default:
      return LightType::kPoint;
  }
}

}  // namespace

void convert_look(const sdf::Visual& from, const std::string& what, const ConvertContext& context,
                  VisualSpec& visual) {
  visual.transparency = std::clamp(static_cast<double>(from.Transparency()), 0.0, 1.0);
  visual.casts_shadows = from.CastShadows();
  visual.visibility_flags = from.VisibilityFlags();
  const auto element = descend(from.Element(), {"material"});
  if (!element) return;
  Material& material = visual.material;
  material.is_given = true;
  read_color(element, "diffuse", material.diffuse);
  material.ambient = material.diffuse;
  read_color(element, "ambient", material.ambient);
  read_color(element, "specular", material.specular);
  read_color(element, "emissive", material.emissive);
  read_script(element, what, context, material);
  read_texture(element, what, context, material);
}

LightSpec convert_light(const sdf::Light& from, const ConvertContext& context) {
  LightSpec light;
  light.name = from.Name();
  light.type = light_type(from.Type());
  light.T_world_light = to_se3(from.RawPose());
  light.diffuse = to_rgba(from.Diffuse());
  light.specular = to_rgba(from.Specular());
  light.casts_shadows = from.CastShadows();
  light.range_m = from.AttenuationRange();
  light.attenuation_constant = from.ConstantAttenuationFactor();
  light.attenuation_linear = from.LinearAttenuationFactor();
  light.attenuation_quadratic = from.QuadraticAttenuationFactor();
  light.spot_inner_rad = from.SpotInnerAngle().Radian();
  light.spot_outer_rad = from.SpotOuterAngle().Radian();
  light.spot_falloff = from.SpotFalloff();
  const Eigen::Vector3d direction = to_eigen(from.Direction());
  if (!(direction.norm() > 1e-9) || !direction.allFinite()) {
    throw Error(context.label + ": light '" + light.name + "': <direction> has no length");
  }
  light.direction_light = direction.normalized();
  return light;
}

SceneSpec convert_scene(const sdf::World& world) {
  SceneSpec scene;
  const sdf::Scene* const from = world.Scene();
  if (from == nullptr) return scene;
  const sdf::ElementPtr element = from->Element();
  if (element) {
    read_color(element, "ambient", scene.ambient);
    read_color(element, "background", scene.background);
  }
  scene.shadows = from->Shadows();
  return scene;
}

}  // namespace trident
