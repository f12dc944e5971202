// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_node_params.h"

#include <algorithm>
#include <vector>

#include "trident_base/string_util.h"
#include "trident_base/yaml_config.h"

namespace trident::estimation {
namespace {

using XmlRpc::XmlRpcValue;

/// Collects the names of a struct's fields.
struct NameList {
  std::vector<std::string> names;
  template <class... Rest>
  void field(const char* name, Rest&&...) {
    names.emplace_back(name);
  }
};

/// A parameter as the same tree that YAML files make.
ConfigNode node_of(XmlRpcValue& value) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kScalar;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      node.scalar = static_cast<bool&>(value) ? "true" : "false";
      break;
    case XmlRpcValue::TypeInt:
      node.scalar = std::to_string(static_cast<int&>(value));
      break;
    case XmlRpcValue::TypeDouble:
      node.scalar = number_text(static_cast<double&>(value));
      break;
    case XmlRpcValue::TypeString:
      node.scalar = static_cast<std::string&>(value);
      node.quoted = true;
      break;
    default:
      node.kind = ConfigNode::Kind::kMap;  // no parameter of this node is one
  }
  return node;
}

}  // namespace

AmclNodeParams read_amcl_params(const ros::NodeHandle& private_node) {
  NameList known;
  AmclNodeParams().visit(known);
  XmlRpcValue root;
  private_node.getParam("", root);
  ConfigNode tree;
  tree.kind = ConfigNode::Kind::kMap;
  if (root.getType() == XmlRpcValue::TypeStruct) {
    for (auto& [name, value] : root) {
      if (std::find(known.names.begin(), known.names.end(), name) == known.names.end()) {
        ROS_WARN("private parameter '%s' is not one that amcl knows; not used", name.c_str());
        continue;
      }
      tree.keys.push_back(name);
      tree.key_lines.push_back(0);
      tree.items.push_back(node_of(value));
    }
  }
  return load_config_node<AmclNodeParams>(tree, "parameters of " + private_node.getNamespace());
}

}  // namespace trident::estimation
