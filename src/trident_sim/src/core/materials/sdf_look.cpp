// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_look.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include "core/sdf/sdf_values.h"
#include "ogre_materials.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

/// Components beyond [0, 1] are brought into it; libsdformat has warned of them.
Eigen::Vector4d to_rgba(const ignition::math::Color& color) {
  const Eigen::Vector4d rgba(color.R(), color.G(), color.B(), color.A());
  return rgba.cwiseMax(0.0).cwiseMin(1.0);
}

void read_color(const sdf::ElementPtr& material, const char* name, Eigen::Vector4d& color) {
  if (material->HasElement(name)) color = to_rgba(material->Get<ignition::math::Color>(name));
}

std::string color_text(const Eigen::Vector4d& color) {
  std::ostringstream text;
  text << "(" << color[0] << " " << color[1] << " " << color[2] << ")";
  return text.str();
}

/// Where the `<uri>`s of a script lead, with those that lead nowhere.
struct ScriptPaths {
  std::vector<std::string> found, missing;
};

ScriptPaths find_script_paths(const sdf::ElementPtr& script, const ConvertContext& context) {
  ScriptPaths paths;
  auto uri = script->HasElement("uri") ? script->GetElement("uri") : nullptr;
  for (; uri; uri = uri->GetNextElement("uri")) {
    const auto text = uri->Get<std::string>();
    // Gazebo's own materials are known here without their file.
    const bool is_gazebos = std::filesystem::path(text).filename() == "gazebo.material";
    const std::string path = context.resources.find(text, context.base_folder);
    if (!path.empty()) {
      paths.found.push_back(path);
    } else if (!is_gazebos && !text.empty() && text != "__default__") {
      paths.missing.push_back(text);
    }
  }
  return paths;
}

/// A script's picture lies in one of the folders named with it, next to the script, in the folder
/// "textures" next to that of the scripts, or among those of GAZEBO_RESOURCE_PATH.
std::string find_script_texture(const std::string& name, const ScriptPaths& paths,
                                const ConvertContext& context) {
  namespace fs = std::filesystem;
  std::vector<fs::path> folders;
  for (const std::string& path : paths.found) {
    std::error_code ignored;
    const fs::path folder =
        fs::is_directory(path, ignored) ? fs::path(path) : fs::path(path).parent_path();
    folders.push_back(folder);
    folders.push_back(folder / ".." / "textures");
    folders.push_back((folder / "").parent_path().parent_path() / "textures");
  }
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (fs::exists(folder / name, ignored)) return (folder / name).lexically_normal().string();
  }
  return context.resources.find("media/materials/textures/" + name, context.base_folder);
}

/// The visual whose look is read: its `<material>`, and its name for messages.
struct Look {
  sdf::ElementPtr element;
  const std::string& what;
};

void warn_of(const Look& look, const std::string& fault, const ConvertContext& context) {
  context.warn(placed(context.label + ": " + look.what + ": " + fault, look.element, context));
}

void set_texture(const std::string& name, const std::string& file, const Look& look,
                 const ConvertContext& context, Material& material) {
  material.texture_file = file;
  if (!file.empty() || !context.scripts->is_first("texture " + name)) return;
  warn_of(look,
          "texture '" + name + "' not found; shown without it, in the colour " +
              color_text(material.diffuse),
          context);
}

/// The material of this name in the first script on disk that has it, or none.
const OgreMaterial* find_on_disk(const std::string& name, const ScriptPaths& paths,
                                 const ConvertContext& context) {
  for (const std::string& path : paths.found) {
    if (const auto* const own = context.scripts->find(path, name, context.warn)) return own;
  }
  return nullptr;
}

/// Once of each name; colours given with the script stand in for a missing file without a word.
void warn_of_unknown(const Look& look, const ScriptPaths& paths, const ConvertContext& context,
                     const Material& material) {
  const bool has_color = look.element->HasElement("diffuse");
  if (has_color && paths.missing.empty()) return;
  if (!context.scripts->is_first("script " + material.script)) return;
  const std::string where = paths.missing.empty() ? "is not known by its name"
                                                  : "not found, nor is '" + paths.missing[0] + "'";
  warn_of(look,
          "material script '" + material.script + "' " + where + "; shown in " +
              (has_color ? "the colour " : "grey ") + color_text(material.diffuse),
          context);
}

/// A script's material stands for its colours; colours given with it count where it is unknown. One
/// that a script on disk has comes before Gazebo's of the same name.
void read_script(const Look& look, const ConvertContext& context, Material& material) {
  const sdf::ElementPtr& element = look.element;
  material.script = value_or(element, {"script", "name"}, std::string());
  if (material.script.empty() || material.script == "__default__") return;
  const ScriptPaths paths = find_script_paths(element->GetElement("script"), context);
  if (const OgreMaterial* const own = find_on_disk(material.script, paths, context)) {
    material.ambient = own->ambient;
    material.diffuse = own->diffuse;
    material.specular = own->specular;
    material.emissive = own->emissive;
    if (own->texture.empty()) return;
    set_texture(own->texture, find_script_texture(own->texture, paths, context), look, context,
                material);
    return;
  }
  if (const OgreMaterial* const known = find_ogre_material(material.script)) {
    material.ambient = known->ambient;
    material.diffuse = known->diffuse;
    return;
  }
  warn_of_unknown(look, paths, context, material);
}

void read_texture(const Look& look, const ConvertContext& context, Material& material) {
  const auto uri = value_or(look.element, {"pbr", "metal", "albedo_map"}, std::string());
  if (uri.empty()) return;
  set_texture(uri, context.resources.find(uri, context.base_folder), look, context, material);
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
  // SDF's default of ambient is black, with which a surface would vanish in the shade.
  material.ambient = material.diffuse;
  read_color(element, "ambient", material.ambient);
  read_color(element, "specular", material.specular);
  read_color(element, "emissive", material.emissive);
  const Look look{element, what};
  read_script(look, context, material);
  read_texture(look, context, material);
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

}  // namespace trident::sim
