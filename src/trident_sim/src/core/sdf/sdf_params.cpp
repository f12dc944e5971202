// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_params.h"

namespace trident::sim {

ParamNode to_param_node(const sdf::ElementPtr& element, std::string_view left_out) {
  ParamNode node;
  node.name = element->GetName();
  if (element->GetValue()) node.text = element->GetValue()->GetAsString();
  for (std::size_t i = 0; i < element->GetAttributeCount(); ++i) {
    const auto attribute = element->GetAttribute(static_cast<unsigned>(i));
    node.attributes.emplace_back(attribute->GetKey(), attribute->GetAsString());
  }
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    if (child->GetName() != left_out) node.children.push_back(to_param_node(child));
  }
  return node;
}

std::vector<PluginSpec> convert_plugins(const sdf::ElementPtr& owner) {
  std::vector<PluginSpec> plugins;
  if (!owner || !owner->HasElement("plugin")) return plugins;
  for (auto element = owner->GetElement("plugin"); element;
       element = element->GetNextElement("plugin")) {
    plugins.push_back({element->Get<std::string>("name"), element->Get<std::string>("filename"),
                       to_param_node(element)});
  }
  return plugins;
}

}  // namespace trident::sim
