// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Parameters of a node: one struct with visit() (trident_base/yaml_config.h) names, checks and
/// documents them, whether they come from the parameter server or from a YAML file.
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident::ros_utils {

/// A parameter as the tree that a YAML file makes: structs become maps, arrays become lists. A
/// string is quoted text, so that "5" is never taken for a number.
ConfigNode to_config_node(XmlRpc::XmlRpcValue value);

/// A parameter that is not set and keeps its default.
struct AbsentParam {
  std::string name;           ///< Relative to the node, e.g. position_gain/x.
  std::string default_value;  ///< As text.
};

/// A parameter that no struct has a field for.
struct UnknownParam {
  std::string name;     ///< Relative to the node.
  std::string nearest;  ///< The known name that is likely meant; empty: no name is near.
};

namespace params_detail {

/// What one look through a tree has found.
struct ParamNotes {
  std::vector<AbsentParam> absent;    ///< keep their defaults
  std::vector<UnknownParam> unknown;  ///< no field has their names
};

/// "parent/name", or "name" at the top.
std::string join_names(const std::string& parent, const std::string& name);
/// roslaunch and rosparam also write 1 and 0 for true and false.
void accept_numeric_flag(ConfigNode& node);
/// `over`, or where both are maps: the keys of both, each with its value of `over` if it has one.
ConfigNode overlaid(const ConfigNode& under, const ConfigNode& over);
/// Removes the keys of a map that are not among `known`, and returns them.
std::vector<std::string> remove_unknown(ConfigNode& map, const std::vector<std::string>& known);
/// Adds them to `notes`, each with the nearest known name.
void note_unknown(const std::string& path, const std::vector<std::string>& unknown,
                  const std::vector<std::string>& known, ParamNotes& notes);

/// Gives the keys of a reference the form ~a/b, and maps of structs a default that can be read.
void use_ros_names(std::vector<config_detail::DocumentRow>& rows);

/// The archive that compares a struct's fields with the keys of a map.
class ParamScan {
 public:
  /// `map` outlives the scan; `path` is its name relative to the node.
  ParamScan(ConfigNode& map, std::string path, ParamNotes& notes)
      : map_(map), path_(std::move(path)), notes_(notes) {}

  /// Compares one field with the map; values are read later, by ConfigReader.
  template <class T>
  void field(const char* name, const T& value, const char* /*doc*/ = "") {
    scan_field(name, value, true);
  }
  template <class T>
  void field(const char* name, const T& value, Range /*range*/, const char* /*doc*/ = "") {
    scan_field(name, value, true);
  }
  /// As field(), but a missing one is not noted: the reader refuses it.
  template <class T>
  void required(const char* name, const T& value, const char* /*doc*/ = "") {
    scan_field(name, value, false);
  }
  template <class T>
  void required(const char* name, const T& value, Range /*range*/, const char* /*doc*/ = "") {
    scan_field(name, value, false);
  }
  /// Names of the fields, in the order of the struct.
  const std::vector<std::string>& known() const { return known_; }

 private:
  template <class T>
  void scan_field(const char* name, const T& value, bool is_optional) {
    known_.emplace_back(name);
    const std::string path = join_names(path_, name);
    const auto key = std::find(map_.keys.begin(), map_.keys.end(), name);
    if (key != map_.keys.end()) {
      scan(map_.items[static_cast<std::size_t>(key - map_.keys.begin())], value, path);
    } else if (is_optional) {
      note_absent(value, path);
    }
  }
  template <class T>
  void scan(ConfigNode& node, const T& value, const std::string& path) {
    if constexpr (std::is_same_v<T, bool>) {
      accept_numeric_flag(node);
    } else if constexpr (config_detail::is_visitable_v<T>) {
      if (node.kind != ConfigNode::Kind::kMap) return;  // the reader refuses it
      ParamScan below(node, path, notes_);
      T copy = value;
      copy.visit(below);
      note_unknown(path, remove_unknown(node, below.known()), below.known(), notes_);
    }
  }
  template <class T>
  void scan(ConfigNode& node, const std::optional<T>& value, const std::string& path) {
    scan(node, value.value_or(T{}), path);
  }
  template <class T>
  void scan(ConfigNode& node, const std::vector<T>& /*value*/, const std::string& path) {
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      scan(node.items[i], T{}, config_detail::item_path(path, i));
    }
  }
  template <class T>
  void scan(ConfigNode& node, const std::map<std::string, T>& /*value*/, const std::string& path) {
    for (std::size_t i = 0; i < node.keys.size(); ++i) {
      scan(node.items[i], T{}, join_names(path, node.keys[i]));
    }
  }
  /// A map's default is shown by its size: its text would be that of a whole vehicle.
  template <class T>
  void note_absent(const std::map<std::string, T>& value, const std::string& path) {
    notes_.absent.push_back({path, "the default of " + std::to_string(value.size()) + " items"});
  }
  template <class T>
  void note_absent(const T& value, const std::string& path) {
    if constexpr (config_detail::is_visitable_v<T>) {
      ConfigNode nothing;
      ParamScan below(nothing, path, notes_);
      T copy = value;
      copy.visit(below);
    } else {
      notes_.absent.push_back({path, config_detail::Describe<T>::text(value)});
    }
  }

  ConfigNode& map_;
  std::string path_;
  ParamNotes& notes_;
  std::vector<std::string> known_;
};

}  // namespace params_detail

/// Names of a parameter struct's fields, nested ones excluded.
template <class T>
std::vector<std::string> param_names() {
  ConfigNode nothing;
  params_detail::ParamNotes notes;
  params_detail::ParamScan scan(nothing, "", notes);
  T value{};
  value.visit(scan);
  return scan.known();
}

/// The private parameters of one node, fetched from the master in one call. Several structs may be
/// read from them; a parameter that none of them has is reported by warnings(). Not thread-safe.
class NodeParams {
 public:
  /// Fetches all parameters of the node's private namespace; none: the tree is empty.
  explicit NodeParams(const ros::NodeHandle& private_node);
  /// `name_space`: absolute name of the node, for messages.
  NodeParams(const XmlRpc::XmlRpcValue& parameters, std::string name_space);
  /// A section of parameters that were read before. Throws ConfigError unless it is a map.
  NodeParams(ConfigNode section, std::string name_space);

  /// `value` with those fields replaced that are set. Nested structs are nested parameter names.
  /// Throws ConfigError with the full name of the parameter, its value and the legal range.
  template <class T>
  T read(T value = T{}) {
    ConfigNode own = tree_;
    params_detail::ParamScan scan(own, "", notes_);
    T copy = value;
    copy.visit(scan);
    params_detail::remove_unknown(own, scan.known());
    accept(scan.known());
    config_detail::ConfigReader::read_struct(own, label(), name_space_, value);
    return value;
  }

  /// The value of a parameter; nullptr when it is not set.
  const ConfigNode* find(const std::string& name) const { return tree_.find(name); }
  /// A map of those parameters that are among `names`, for a reader of its own.
  ConfigNode subtree(const std::vector<std::string>& names) const;
  /// Sets a parameter, here alone; the parameter server keeps what it has.
  void set(const std::string& name, ConfigNode value);
  /// Removes a parameter, here alone, and returns it; std::nullopt when it is not set.
  std::optional<ConfigNode> take(const std::string& name);

  /// All these parameters, with those of `own` in place of theirs, sections key by key; named as
  /// `own` is.
  NodeParams overlaid(const NodeParams& own) const;

  /// These names are read elsewhere.
  void accept(const std::vector<std::string>& names);
  /// These names of the upstream package mean nothing here; those that are set share one warning.
  void accept_without_effect(const std::vector<std::string>& names);

  /// Adds a sentence to warnings(), before all others.
  void add_warning(std::string sentence) { added_warnings_.push_back(std::move(sentence)); }

  /// Parameters of the structs read so far that are not set, in the order of their fields.
  const std::vector<AbsentParam>& absent() const { return notes_.absent; }
  /// Parameters that nothing has asked for, ordered by name.
  std::vector<UnknownParam> unknown() const;
  /// Sentences that were added, one for all parameters without effect, then one for each unknown
  /// parameter.
  std::vector<std::string> warnings() const;
  /// Logs these sentences as warnings.
  void log_warnings() const;

  const std::string& name_space() const { return name_space_; }  ///< of the node, absolute
  /// How error texts call their source: "parameter".
  static const std::string& label();

 private:
  ConfigNode tree_;
  std::string name_space_;
  std::vector<std::string> known_, without_effect_, added_warnings_;
  params_detail::ParamNotes notes_;
};

/// Reads all private parameters of a node into one struct, and logs a warning about each that the
/// struct does not have. Throws ConfigError as NodeParams::read() does.
template <class T>
T load_params(const ros::NodeHandle& private_node, T defaults = T{}) {
  NodeParams params(private_node);
  T value = params.read<T>(std::move(defaults));
  params.log_warnings();
  return value;
}

/// The reference table of a struct's parameters in markdown, under the names that ROS uses (~a/b).
template <class T>
std::string document_params(const T& defaults = T{}) {
  std::vector<config_detail::DocumentRow> rows;
  config_detail::ConfigDocumenter documenter("", &rows);
  T copy = defaults;
  copy.visit(documenter);
  params_detail::use_ros_names(rows);
  return config_detail::markdown_table(rows);
}

/// The text of a page of docs/reference/parameters, of which a test compares it with the structs:
/// its license, a heading, a paragraph, and tables.
std::string params_page(const std::string& heading, const std::string& paragraph,
                        const std::string& tables);
/// The text of a page as it is on disk, "" when there is no such file. With TRIDENT_WRITE_DOCS=1 in
/// the environment, `text` is written there first.
std::string page_on_disk(const std::string& path, const std::string& text);

}  // namespace trident::ros_utils
