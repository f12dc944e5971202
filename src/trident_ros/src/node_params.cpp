// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/node_params.h"

#include <ros/console.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "trident_base/string_util.h"

namespace trident::ros_utils {
namespace {

using XmlRpc::XmlRpcValue;

/// Whole numbers of a double are exact up to here (2^53).
constexpr double kMaxExactWhole = 9'007'199'254'740'992.0;

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whole numbers have no exponent, so that 1e6 can be read as a count, too.
std::string text_of(double value) {
  const bool is_whole =
      std::abs(value) <= kMaxExactWhole && value == std::trunc(value) && value != 0.0;
  return is_whole ? std::to_string(static_cast<long long>(value)) : number_text(value);
}

void add(ConfigNode& map, const std::string& name, ConfigNode value) {
  map.keys.push_back(name);
  map.key_lines.push_back(0);
  map.items.push_back(std::move(value));
}

void erase(ConfigNode& map, std::size_t index) {
  const auto at = static_cast<std::ptrdiff_t>(index);
  map.keys.erase(map.keys.begin() + at);
  map.key_lines.erase(map.key_lines.begin() + at);
  map.items.erase(map.items.begin() + at);
}

ConfigNode scalar(std::string text, bool is_quoted) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kScalar;
  node.scalar = std::move(text);
  node.quoted = is_quoted;
  return node;
}

ConfigNode map_of(XmlRpcValue& value) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kMap;
  for (auto& [name, item] : value) add(node, name, to_config_node(item));
  return node;
}

ConfigNode sequence_of(XmlRpcValue& value) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kSequence;
  for (int i = 0; i < value.size(); ++i) node.items.push_back(to_config_node(value[i]));
  return node;
}

XmlRpcValue private_parameters(const ros::NodeHandle& private_node) {
  XmlRpcValue root;
  private_node.getParam("", root);  // a node without parameters: root stays invalid
  return root;
}

}  // namespace

ConfigNode to_config_node(XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return scalar(static_cast<bool&>(value) ? "true" : "false", false);
    case XmlRpcValue::TypeInt:
      return scalar(std::to_string(static_cast<int&>(value)), false);
    case XmlRpcValue::TypeDouble:
      return scalar(text_of(static_cast<double&>(value)), false);
    case XmlRpcValue::TypeString:
      return scalar(static_cast<std::string&>(value), true);
    case XmlRpcValue::TypeArray:
      return sequence_of(value);
    case XmlRpcValue::TypeStruct:
      return map_of(value);
    case XmlRpcValue::TypeDateTime:
      return scalar("a date", true);
    case XmlRpcValue::TypeBase64:
      return scalar("binary data", true);
    default:
      return {};
  }
}

namespace params_detail {

std::string join_names(const std::string& parent, const std::string& name) {
  return parent.empty() ? name : parent + '/' + name;
}

void accept_numeric_flag(ConfigNode& node) {
  if (node.kind != ConfigNode::Kind::kScalar || node.quoted) return;
  if (node.scalar == "1") node.scalar = "true";
  if (node.scalar == "0") node.scalar = "false";
}

ConfigNode overlaid(const ConfigNode& under, const ConfigNode& over) {
  if (under.kind != ConfigNode::Kind::kMap || over.kind != ConfigNode::Kind::kMap) return over;
  ConfigNode result = under;
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    const auto found = std::find(result.keys.begin(), result.keys.end(), over.keys[i]);
    if (found == result.keys.end()) {
      add(result, over.keys[i], over.items[i]);
    } else {
      ConfigNode& item = result.items[static_cast<std::size_t>(found - result.keys.begin())];
      item = overlaid(item, over.items[i]);
    }
  }
  return result;
}

std::vector<std::string> remove_unknown(ConfigNode& map, const std::vector<std::string>& known) {
  std::vector<std::string> unknown;
  for (std::size_t i = map.keys.size(); i-- > 0;) {
    if (has(known, map.keys[i])) continue;
    unknown.insert(unknown.begin(), map.keys[i]);
    erase(map, i);
  }
  return unknown;
}

void note_unknown(const std::string& path, const std::vector<std::string>& unknown,
                  const std::vector<std::string>& known, ParamNotes& notes) {
  for (const std::string& name : unknown) {
    const std::string nearest = closest_match(name, known);
    notes.unknown.push_back(
        {join_names(path, name), nearest.empty() ? "" : join_names(path, nearest)});
  }
}

void use_ros_names(std::vector<config_detail::DocumentRow>& rows) {
  for (config_detail::DocumentRow& row : rows) {
    std::replace(row.key.begin(), row.key.end(), '.', '/');
    row.key.insert(0, "~");
    const std::string& text = row.default_value;
    if (row.type != "map of name: map" || text == "{}") continue;
    row.default_value = std::to_string(1 + std::count(text.begin(), text.end(), ',')) + " items";
  }
}

}  // namespace params_detail

NodeParams::NodeParams(const ros::NodeHandle& private_node)
    : NodeParams(private_parameters(private_node), private_node.getNamespace()) {}

NodeParams::NodeParams(const XmlRpcValue& parameters, std::string name_space)
    : name_space_(std::move(name_space)) {
  if (parameters.getType() == XmlRpcValue::TypeStruct) tree_ = to_config_node(parameters);
  tree_.kind = ConfigNode::Kind::kMap;
}

NodeParams::NodeParams(ConfigNode section, std::string name_space)
    : tree_(std::move(section)), name_space_(std::move(name_space)) {
  config_detail::expect_map({label(), Range::any(), ""}, tree_, name_space_);
}

const std::string& NodeParams::label() {
  static const std::string text = "parameter";
  return text;
}

NodeParams NodeParams::overlaid(const NodeParams& own) const {
  NodeParams result = own;
  result.tree_ = params_detail::overlaid(tree_, own.tree_);
  return result;
}

ConfigNode NodeParams::subtree(const std::vector<std::string>& names) const {
  ConfigNode result = tree_;
  params_detail::remove_unknown(result, names);
  return result;
}

void NodeParams::set(const std::string& name, ConfigNode value) {
  take(name);
  add(tree_, name, std::move(value));
}

std::optional<ConfigNode> NodeParams::take(const std::string& name) {
  for (std::size_t i = 0; i < tree_.keys.size(); ++i) {
    if (tree_.keys[i] != name) continue;
    ConfigNode value = std::move(tree_.items[i]);
    erase(tree_, i);
    return value;
  }
  return std::nullopt;
}

void NodeParams::accept(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (!has(known_, name)) known_.push_back(name);
  }
}

void NodeParams::accept_without_effect(const std::vector<std::string>& names) {
  without_effect_.insert(without_effect_.end(), names.begin(), names.end());
}

std::vector<UnknownParam> NodeParams::unknown() const {
  params_detail::ParamNotes notes = notes_;
  std::vector<std::string> names;
  for (const std::string& name : tree_.keys) {
    if (!has(known_, name) && !has(without_effect_, name)) names.push_back(name);
  }
  params_detail::note_unknown("", names, known_, notes);
  const auto by_name = [](const UnknownParam& a, const UnknownParam& b) { return a.name < b.name; };
  std::stable_sort(notes.unknown.begin(), notes.unknown.end(), by_name);
  return notes.unknown;
}

namespace {

std::string warning_of(const UnknownParam& param, const std::string& name_space) {
  std::string text = "parameter " + name_space + '/' + param.name + " is unknown, not used";
  if (!param.nearest.empty()) text += "; did you mean " + param.nearest + '?';
  return text;
}

}  // namespace

std::vector<std::string> NodeParams::warnings() const {
  std::vector<std::string> sentences = added_warnings_;
  std::vector<std::string> idle;
  for (const std::string& name : tree_.keys) {
    if (!has(known_, name) && has(without_effect_, name)) idle.push_back(name);
  }
  if (!idle.empty()) sentences.push_back("parameters without effect here: " + join(idle));
  for (const UnknownParam& param : unknown()) {
    sentences.push_back(warning_of(param, name_space_));
  }
  return sentences;
}

void NodeParams::log_warnings() const {
  for (const std::string& text : warnings()) ROS_WARN("%s", text.c_str());
}

std::string params_page(const std::string& heading, const std::string& paragraph,
                        const std::string& tables) {
  return "<!-- SPDX-FileCopyrightText: 2026 The Trident authors -->\n"
         "<!-- SPDX-License-Identifier: Apache-2.0 -->\n# " +
         heading + "\n\n" + paragraph + "\n\n" + tables;
}

std::string page_on_disk(const std::string& path, const std::string& text) {
  const char* const is_written = std::getenv("TRIDENT_WRITE_DOCS");
  if (is_written != nullptr && std::string(is_written) == "1") std::ofstream(path) << text;
  std::ostringstream content;
  content << std::ifstream(path).rdbuf();
  return content.str();
}

}  // namespace trident::ros_utils
