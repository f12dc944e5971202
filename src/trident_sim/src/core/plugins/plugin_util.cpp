// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugin_util.h"

#include <algorithm>
#include <sstream>

namespace trident::sim {
namespace {

std::string without_outer_slashes(const std::string& text) {
  const auto first = text.find_first_not_of('/');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of('/') - first + 1);
}

}  // namespace

std::string scoped_topic(const PluginParams& params, const std::string& topic) {
  std::string clean = without_outer_slashes(topic);
  if (!topic.empty() && topic.front() == '/') return clean;
  const std::string ns = without_outer_slashes(params.text("robotNamespace", ""));
  return ns.empty() ? clean : ns + "/" + clean;
}

std::string robot_topic(const PluginContext& context, const std::string& topic) {
  return scoped_topic(context.params, topic);
}

std::string vehicle_topic(const PluginContext& context, const std::string& topic) {
  std::string vehicle = without_outer_slashes(context.params.text("robotNamespace", ""));
  if (vehicle.empty() && context.model != nullptr) vehicle = context.model->name;
  return vehicle + "/" + without_outer_slashes(topic);
}

Link& required_link(const PluginContext& context, const std::string& key) {
  const std::string name = context.params.required_text(key);
  if (context.model == nullptr) throw Error(context.params.owner() + ": belongs in a model");
  Link* link = context.model->find_link(name);
  if (link == nullptr && name.front() == '/') link = context.model->find_link(name.substr(1));
  if (link == nullptr) {
    std::string known;
    for (const auto& other : context.model->links)
      known += (known.empty() ? "" : ", ") + other->name;
    context.params.refuse(key, name, "a link of the model: " + known);
  }
  return *link;
}

Link& own_link(const PluginContext& context) {
  if (context.link != nullptr) return *context.link;
  if (context.params.has("linkName")) return required_link(context, "linkName");
  if (context.model == nullptr || context.model->canonical_link() == nullptr) {
    throw Error(context.params.owner() + ": belongs in a model with a link");
  }
  return *context.model->canonical_link();
}

OutHandle<FrameSample> advertise_frame(const PluginContext& context, const std::string& parent,
                                       const std::string& child) {
  const std::string name = "tf/" + child;
  if (context.world.ports().find(name, PortDirection::kOut) != nullptr) {
    context.world.report(Severity::kWarning,
                         context.params.owner() + ": frame '" + child +
                             "' has a transform already, so that this plugin sends none; robots "
                             "need frames of their own, e.g. by a tf_prefix");
    return {};
  }
  auto frame = advertise<FrameSample>(context, name, PortRank::kTransform);
  frame->value.parent_frame = parent;
  frame->value.child_frame = child;
  return frame;
}

Joint& required_joint(const PluginContext& context, const std::string& key) {
  return joint_or(context, key, context.params.required_text(key));
}

Joint& joint_or(const PluginContext& context, const std::string& key, const std::string& fallback) {
  const std::string name = context.params.text(key, fallback);
  if (context.model == nullptr) throw Error(context.params.owner() + ": belongs in a model");
  Joint* joint = context.model->find_joint(name);
  if (joint == nullptr) {
    std::string known;
    for (const auto& other : context.model->joints) {
      known += (known.empty() ? "" : ", ") + other->spec.name;
    }
    context.params.refuse(key, name, "a joint of the model: " + known);
  }
  return *joint;
}

std::vector<Joint*> listed_joints(const PluginContext& context, std::size_t least_axes) {
  const std::string legal = "names of joints of the model";
  std::string list = context.params.required_text("jointName");
  if (context.model == nullptr) throw Error(context.params.owner() + ": belongs in a model");
  std::replace(list.begin(), list.end(), ',', ' ');
  std::vector<Joint*> joints;
  std::istringstream names(list);
  for (std::string name; names >> name;) {
    Joint* const joint = context.model->find_joint(name);
    if (joint == nullptr || joint->axis_count() < least_axes) {
      context.params.refuse("jointName", name, legal + (least_axes > 0 ? " that can turn" : ""));
    }
    joints.push_back(joint);
  }
  if (joints.empty()) context.params.refuse("jointName", list, legal);
  return joints;
}

Eigen::Vector3d link_velocity_world(const Link& link) {
  return link.v_world_at(link.T_world_link().p);
}

Eigen::Vector3d link_acceleration_world(const Link& link, double dt_s) {
  if (link.body == nullptr) return Eigen::Vector3d::Zero();
  const Body& body = *link.body;
  const Eigen::Vector3d r = link.T_world_link().p - body.pose().p;
  const Eigen::Vector3d& w = body.angular_velocity();
  const Eigen::Vector3d linear = (body.velocity() - body.previous_velocity()) / dt_s;
  const Eigen::Vector3d angular = (w - body.previous_angular_velocity()) / dt_s;
  return linear + angular.cross(r) + w.cross(w.cross(r));
}

}  // namespace trident::sim
