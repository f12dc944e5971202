// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/costmap_config.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "config_map.h"
#include "key_table.h"
#include "trident_base/string_util.h"
#include "trident_nav/costmap/beam_source.h"

namespace trident::nav {
namespace {

std::string key_path(const std::string& path, const std::string& key) {
  std::string result = path;
  result += '/';
  return result += key;
}

enum class Form { kPlugins, kOld, kNav2 };

/// The parameters within `ros__parameters`, at most two maps deep; otherwise the map itself.
const ConfigNode& ros_parameters(const ConfigNode& config) {
  const ConfigNode* at = &config;
  for (int depth = 0; depth < 3; ++depth) {
    if (const ConfigNode* found = at->find("ros__parameters")) return *found;
    if (at->items.size() != 1) break;
    at = &at->items[0];
  }
  return config;
}

Form form_of(const ConfigNode& config) {
  const ConfigNode* plugins = config.find("plugins");
  if (plugins == nullptr) return Form::kOld;
  const bool has_maps =
      std::any_of(plugins->items.begin(), plugins->items.end(),
                  [](const ConfigNode& item) { return item.kind == ConfigNode::Kind::kMap; });
  return has_maps || plugins->items.empty() ? Form::kPlugins : Form::kNav2;
}

/// A list of corners as the text that it would be.
std::string polygon_text(const ConfigNode& node) {
  if (node.kind != ConfigNode::Kind::kSequence) return node.scalar;
  std::vector<std::string> parts;
  for (const ConfigNode& item : node.items) parts.push_back(polygon_text(item));
  return "[" + join(parts) + "]";
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class CostmapConfigReader {
 public:
  CostmapConfigReader(const ConfigNode& config, const CostmapConfigSource& source,
                      const Registry<LayerType>& registry)
      : source_(source), registry_(registry), costmap_(ros_parameters(config)) {
    if (costmap_.kind == ConfigNode::Kind::kNull) costmap_ = empty_map();
    form_ = &ros_parameters(config) != &config && costmap_.find("plugins") == nullptr
                ? Form::kNav2
                : form_of(costmap_);
  }

  /// The three forms are brought into one before anything is checked, so that a message names the
  /// key that the user has written.
  CostmapConfig read() {
    config_detail::expect_map({source_.label, Range::any(), ""}, costmap_, source_.path);
    rename_keys();
    inherit_costmap_keys();
    note_source_defaults();
    switch (form_) {
      case Form::kPlugins:
        read_plugins();
        break;
      case Form::kOld:
        read_old();
        break;
      case Form::kNav2:
        read_nav2();
        break;
    }
    for (LayerSpec& spec : result_.layers) finish_layer(spec);
    read_params();
    return std::move(result_);
  }

 private:
  std::string path_of(const std::string& key) const { return source_.path + "/" + key; }
  void warn(const std::string& path, const std::string& problem) {
    result_.warnings.push_back(path + " " + problem);
  }
  [[noreturn]] void fail(const ConfigNode& node, const std::string& key,
                         const std::string& problem) const {
    throw ConfigError(source_.label, node.line, path_of(key), problem);
  }

  void rename_keys() {
    for (const RenamedKey& renamed : kRenamedCostmapKeys) {
      if (costmap_.find(renamed.old_name) == nullptr) continue;
      warn(path_of(renamed.old_name), std::string("is taken as ") + renamed.name);
      std::optional<ConfigNode> value = take_key(costmap_, renamed.old_name);
      if (costmap_.find(renamed.name) == nullptr) set_key(costmap_, renamed.name, *value);
    }
  }
  void inherit_costmap_keys() {
    for (const char* key : kInheritedCostmapKeys) {
      const ConfigNode* value = source_.above != nullptr ? source_.above->find(key) : nullptr;
      if (value != nullptr && costmap_.find(key) == nullptr) set_key(costmap_, key, *value);
    }
  }
  /// What sources take that have no such key themselves, and neither has their layer.
  void note_source_defaults() {
    source_defaults_ = empty_map();
    for (const char* key : kInheritedSourceKeys) {
      const ConfigNode* above = source_.above != nullptr ? source_.above->find(key) : nullptr;
      std::optional<ConfigNode> own = take_key(costmap_, key);
      if (own || above != nullptr) set_key(source_defaults_, key, own ? *own : *above);
    }
  }

  void read_plugins() {
    const std::optional<ConfigNode> plugins = take_key(costmap_, "plugins");
    for (const ConfigNode& item : plugins->items) {
      const ConfigNode* name = item.find("name");
      const ConfigNode* type = item.find("type");
      if (name == nullptr || type == nullptr || name->scalar.empty() || type->scalar.empty()) {
        fail(item, "plugins", "each plugin must have a name and a type, not " + item.describe());
      }
      add_layer(name->scalar, type->scalar, take_key(costmap_, name->scalar), item.line);
    }
  }

  /// Before there were plugins, `static_map` and `map_type` chose the layers, and their parameters
  /// stood next to the costmap's own (costmap_2d before Hydro).
  void read_old() {
    if (is_true(costmap_.find("static_map"))) {
      LayerSpec& map = add_old_layer("static_layer", "costmap_2d::StaticLayer", kOldStaticKeys);
      copy_key("track_unknown_space", map.setup.config);
    }
    take_key(costmap_, "static_map");
    const bool has_voxels = take_map_type() == "voxel";
    LayerSpec& obstacles = add_old_layer(
        "obstacle_layer", has_voxels ? "costmap_2d::VoxelLayer" : "costmap_2d::ObstacleLayer",
        kOldObstacleKeys);
    for (const char* key : kOldVoxelKeys) {
      if (has_voxels) move_key(costmap_, obstacles.setup.config, key);
    }
    for (const std::string& name : source_names(obstacles.setup.config)) {
      move_key(costmap_, obstacles.setup.config, name);
    }
    add_old_layer("inflation_layer", "costmap_2d::InflationLayer", kOldInflationKeys);
  }
  /// What the obstacle layer of before there were plugins is.
  std::string take_map_type() {
    const std::optional<ConfigNode> type = take_key(costmap_, "map_type");
    if (!type) return "costmap";
    if (type->scalar != "voxel" && type->scalar != "costmap") {
      fail(*type, "map_type", "is '" + type->scalar + "'; costmap and voxel are legal");
    }
    return type->scalar;
  }
  void copy_key(const char* key, ConfigNode& to) const {
    const ConfigNode* value = costmap_.find(key);
    if (value != nullptr && to.find(key) == nullptr) set_key(to, key, *value);
  }
  /// A layer whose parameters are the costmap's, or below its name.
  template <class Keys>
  LayerSpec& add_old_layer(const std::string& name, const std::string& plugin, const Keys& keys) {
    ConfigNode config = take_key(costmap_, name).value_or(empty_map());
    for (const char* key : keys) move_key(costmap_, config, key);
    add_layer(name, plugin, std::move(config), 0);
    return result_.layers.back();
  }

  void read_nav2() {
    set_nav2_defaults();
    for (const std::string& name : take_nav2_layers()) add_nav2_layer(name);
    for (const char* key : kNav2StaticKeys) {
      if (std::string(key) != "track_unknown_space") take_key(costmap_, key);
    }
    const std::optional<ConfigNode> filters = take_key(costmap_, "filters");
    if (filters) refuse_filters(*filters);
  }
  /// The names of the layers, by default those of nav2's costmap.
  std::vector<std::string> take_nav2_layers() {
    const std::optional<ConfigNode> plugins = take_key(costmap_, "plugins");
    if (!plugins) return {"static_layer", "obstacle_layer", "inflation_layer"};
    std::vector<std::string> names;
    for (const ConfigNode& item : plugins->items) names.push_back(item.scalar);
    return names;
  }
  /// A static layer takes the costmap's keys too, as nav2's does.
  void add_nav2_layer(const std::string& name) {
    ConfigNode config = take_key(costmap_, name).value_or(empty_map());
    const std::optional<ConfigNode> plugin = take_key(config, "plugin");
    const std::string type = plugin ? plugin->scalar : default_nav2_plugin(name);
    if (!plugin && type.empty()) fail(config, name, "has no plugin: it must say which it is");
    if (plugin_class(type) == "StaticLayer") {
      for (const char* key : kNav2StaticKeys) copy_key(key, config);
    }
    add_layer(name, type, std::move(config), 0);
  }
  void refuse_filters(const ConfigNode& filters) {
    for (const ConfigNode& item : filters.items) {
      take_key(costmap_, item.scalar);
      warn(path_of(item.scalar), "has no effect: there are no costmap filters yet");
    }
  }
  static std::string default_nav2_plugin(const std::string& name) {
    if (name == "static_layer") return "nav2_costmap_2d::StaticLayer";
    if (name == "obstacle_layer") return "nav2_costmap_2d::ObstacleLayer";
    if (name == "inflation_layer") return "nav2_costmap_2d::InflationLayer";
    return "";
  }
  void set_nav2_defaults() {
    const std::pair<const char*, const char*> defaults[] = {{"width", "5"},
                                                            {"height", "5"},
                                                            {"resolution", "0.1"},
                                                            {"robot_radius", "0.1"},
                                                            {"track_unknown_space", "false"},
                                                            {"publish_frequency", "1"}};
    for (const auto& [key, value] : defaults) {
      if (costmap_.find(key) == nullptr) set_key(costmap_, key, text_node(value, false));
    }
  }

  /// A layer that has no counterpart here is left out with its reason; a name that is not known at
  /// all is an error, since the map would lack what it should show.
  void add_layer(const std::string& name, const std::string& plugin,
                 std::optional<ConfigNode> config, int line) {
    for (const IgnoredKey& ignored : kIgnoredPlugins) {
      if (plugin_class(plugin) != ignored.key) continue;
      warn(path_of(name), "of type " + plugin + " is left out: " + ignored.why);
      return;
    }
    LayerSpec spec;
    spec.plugin = plugin;
    spec.setup.name = name;
    spec.setup.source = source_.label;
    spec.setup.path = path_of(name);
    if (config && config->kind != ConfigNode::Kind::kNull) spec.setup.config = std::move(*config);
    config_detail::expect_map({source_.label, Range::any(), ""}, spec.setup.config,
                              spec.setup.path);
    if (registry_.find(plugin_class(plugin)) == nullptr) {
      throw ConfigError(
          source_.label, line, spec.setup.path,
          "no layer plugin is called '" + plugin + "'; known: " + join(registry_.names()));
    }
    result_.layers.push_back(std::move(spec));
  }

  /// Puts the sources where the layer's struct has them, and removes what it does not have.
  void finish_layer(LayerSpec& spec) {
    ConfigNode& config = spec.setup.config;
    const LayerType& type = *registry_.find(plugin_class(spec.plugin));
    if (contains(type.parameters, "sources")) gather_sources(spec);
    if (form_ == Form::kNav2) translate_combination(config);
    remove_unknown(config, type.parameters, kIgnoredLayerKeys, spec.setup.path);
    spec.setup.is_tracking_unknown = is_true(costmap_.find("track_unknown_space"));
  }
  /// Nav2's method 2 is another one than costmap_2d's.
  static void translate_combination(ConfigNode& config) {
    const ConfigNode* method = config.find("combination_method");
    if (method != nullptr && method->scalar == "2") {
      set_key(config, "combination_method", text_node("3", false, method->line));
    }
  }
  static std::vector<std::string> source_names(const ConfigNode& config) {
    const ConfigNode* names = config.find("observation_sources");
    return names != nullptr ? words_of(names->scalar) : std::vector<std::string>{};
  }
  /// Moves the sources that a layer lists below one key. What they do not say themselves comes from
  /// their layer, then from the costmap, as costmap_2d searches its parameters.
  void gather_sources(LayerSpec& spec) {
    ConfigNode& config = spec.setup.config;
    const std::vector<std::string> names = source_names(config);
    take_key(config, "observation_sources");
    ConfigNode defaults = source_defaults_;
    for (const char* key : kInheritedSourceKeys) {
      if (std::optional<ConfigNode> value = take_key(config, key)) set_key(defaults, key, *value);
    }
    ConfigNode sources = empty_map();
    for (const std::string& name : names) {
      ConfigNode source = take_key(config, name).value_or(empty_map());
      config_detail::expect_map({source_.label, Range::any(), ""}, source,
                                spec.setup.path + "/" + name);
      set_key(sources, name,
              finished_source(std::move(source), defaults, spec.setup.path + "/" + name));
    }
    warn_of_unlisted(config, spec.setup.path);
    set_key(config, "sources", std::move(sources));
  }
  static void rename_nav2_keys(ConfigNode& source) {
    for (const RenamedKey& renamed : kNav2SourceKeys) {
      std::optional<ConfigNode> value = take_key(source, renamed.old_name);
      if (value) set_key(source, renamed.name, std::move(*value));
    }
  }
  static void add_missing(ConfigNode& source, const ConfigNode& defaults) {
    for (std::size_t i = 0; i < defaults.keys.size(); ++i) {
      if (source.find(defaults.keys[i]) == nullptr) {
        set_key(source, defaults.keys[i], defaults.items[i]);
      }
    }
  }
  ConfigNode finished_source(ConfigNode source, const ConfigNode& defaults,
                             const std::string& path) {
    rename_nav2_keys(source);
    add_missing(source, defaults);
    if (form_ == Form::kNav2 && source.find("data_type") == nullptr) {
      set_key(source, "data_type", text_node("LaserScan", true));
    }
    remove_unknown(source, layer_detail::field_names<BeamSourceParams>(), kIgnoredSourceKeys, path);
    return source;
  }
  /// Maps that look like sources, but that observation_sources does not name.
  void warn_of_unlisted(ConfigNode& config, const std::string& path) {
    const std::vector<std::string> keys = config.keys;
    for (const std::string& key : keys) {
      const ConfigNode* node = config.find(key);
      if (node->kind != ConfigNode::Kind::kMap) continue;
      warn(key_path(path, key), "has no effect: observation_sources does not name it");
      take_key(config, key);
    }
  }

  void read_params() {
    warn_of_unused_layers();
    for (const char* key : {"global_frame", "robot_base_frame"}) strip_slash(key);
    if (const ConfigNode* footprint = costmap_.find("footprint")) {
      set_key(costmap_, "footprint", text_node(polygon_text(*footprint), true, footprint->line));
    }
    remove_unknown(costmap_, layer_detail::field_names<CostmapParams>(), kIgnoredCostmapKeys,
                   source_.path);
    layer_detail::FlagReader flags(costmap_);
    result_.params.visit(flags);
    config_detail::ConfigReader::read_struct(costmap_, source_.label, source_.path, result_.params);
  }

  void warn_of_unused_layers() {
    const std::vector<std::string> keys = costmap_.keys;
    for (const std::string& key : keys) {
      if (costmap_.find(key)->kind != ConfigNode::Kind::kMap) continue;
      warn(path_of(key), "has no effect: no plugin has this name");
      take_key(costmap_, key);
    }
  }
  /// Names of frames began with a slash in tf's first version.
  void strip_slash(const char* key) {
    const ConfigNode* node = costmap_.find(key);
    if (node == nullptr || node->scalar.empty() || node->scalar.front() != '/') return;
    ConfigNode stripped = *node;
    stripped.scalar.erase(0, 1);
    set_key(costmap_, key, std::move(stripped));
  }

  /// Removes keys that are not known, with one warning each.
  template <class Ignored>
  /// One warning per key that has no effect: upstream's files hold keys that nobody reads, and a
  /// misspelt one must be seen.
  void remove_unknown(ConfigNode& map, const std::vector<std::string>& known,
                      const Ignored& ignored, const std::string& path) {
    const std::vector<std::string> keys = map.keys;
    for (const std::string& key : keys) {
      if (contains(known, key)) continue;
      take_key(map, key);
      const auto entry = std::find_if(ignored.begin(), ignored.end(),
                                      [&](const IgnoredKey& other) { return key == other.key; });
      if (entry != ignored.end()) {
        warn(key_path(path, key), std::string("has no effect: ") + entry->why);
        continue;
      }
      const std::string nearest = closest_match(key, known);
      warn(key_path(path, key), "is not known and has no effect" +
                                    (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
  }

  const CostmapConfigSource& source_;
  const Registry<LayerType>& registry_;
  ConfigNode costmap_;
  Form form_;
  ConfigNode source_defaults_;
  CostmapConfig result_;
};

}  // namespace

CostmapConfig read_costmap_config(const ConfigNode& config, const CostmapConfigSource& source,
                                  const Registry<LayerType>& registry) {
  return CostmapConfigReader(config, source, registry).read();
}

std::vector<std::unique_ptr<Layer>> make_layers(const CostmapConfig& config,
                                                const Registry<LayerType>& registry) {
  std::vector<std::unique_ptr<Layer>> layers;
  for (const LayerSpec& spec : config.layers) {
    layers.push_back(make_layer(registry, spec.plugin, spec.setup));
  }
  return layers;
}

}  // namespace trident::nav
