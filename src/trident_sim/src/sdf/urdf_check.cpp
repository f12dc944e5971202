// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <tinyxml2.h>

#include <Eigen/Eigenvalues>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_sim/sdf_loader.h"
#include "urdf_elements.h"

namespace trident {
namespace {

std::string place(const std::string& label, const tinyxml2::XMLElement& element,
                  const std::string& link) {
  return label + ":" + std::to_string(element.GetLineNum()) + ": link '" + link + "'";
}

double attribute(const tinyxml2::XMLElement* element, const char* name, const std::string& where) {
  const char* text = element == nullptr ? nullptr : element->Attribute(name);
  double value = 0.0;
  if (text == nullptr) throw Error(where + ": inertial has no '" + name + "'");
  if (element->QueryDoubleAttribute(name, &value) != tinyxml2::XML_SUCCESS ||
      !std::isfinite(value)) {
    throw Error(where + ": inertial " + name + " = '" + text + "' is not a finite number");
  }
  return value;
}

void check_inertial(const tinyxml2::XMLElement& inertial, const std::string& where) {
  const double mass = attribute(inertial.FirstChildElement("mass"), "value", where);
  if (mass <= 0.0) {
    std::ostringstream text;
    text << where << ": mass is " << mass << " kg, must be > 0";
    throw Error(text.str());
  }
  const auto* element = inertial.FirstChildElement("inertia");
  const auto at = [&](const char* name) { return attribute(element, name, where); };
  // First all numbers: a refusal amid a matrix' comma list would trip Eigen's check of its length.
  const double xx = at("ixx"), xy = at("ixy"), xz = at("ixz");
  const double yy = at("iyy"), yz = at("iyz"), zz = at("izz");
  Eigen::Matrix3d inertia;
  inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const double smallest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .minCoeff();
  if (!(smallest > 0.0)) {
    std::ostringstream text;
    text << where << ": inertia is not positive definite (smallest eigenvalue " << smallest
         << " kg m^2, must be > 0)";
    throw Error(text.str());
  }
}

struct JointEnds {
  std::string parent, child;
  bool fixed = false;
};

std::vector<JointEnds> read_joints(const tinyxml2::XMLElement& robot) {
  std::vector<JointEnds> joints;
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const auto* parent = joint->FirstChildElement("parent");
    const auto* child = joint->FirstChildElement("child");
    if (parent == nullptr || child == nullptr) continue;
    if (parent->Attribute("link") == nullptr || child->Attribute("link") == nullptr) continue;
    joints.push_back({parent->Attribute("link"), child->Attribute("link"),
                      joint->Attribute("type", "fixed") != nullptr});
  }
  return joints;
}

/// Links without inertia that are mere frames of what a fixed joint joins them to: nothing that
/// moves hangs on them.
std::set<std::string> mere_frames(const std::vector<JointEnds>& joints,
                                  const std::set<std::string>& with_inertia) {
  std::set<std::string> frames, holders;
  for (const JointEnds& joint : joints) {
    if (joint.fixed && with_inertia.count(joint.child) == 0) frames.insert(joint.child);
    if (!joint.fixed) holders.insert(joint.parent);
  }
  for (bool grown = true; grown;) {
    grown = false;
    for (const JointEnds& joint : joints) {
      if (frames.count(joint.child) == 0 || holders.count(joint.child) == 0) continue;
      if (holders.insert(joint.parent).second) grown = true;
    }
  }
  for (const std::string& holder : holders) frames.erase(holder);
  return frames;
}

/// Links that are rigidly joined to a link with inertia on the child side.
std::set<std::string> carried_inertia(const std::vector<JointEnds>& joints,
                                      const std::set<std::string>& with_inertia) {
  std::set<std::string> result = with_inertia;
  for (bool grown = true; grown;) {
    grown = false;
    for (const JointEnds& joint : joints) {
      if (!joint.fixed || result.count(joint.child) == 0) continue;
      if (result.insert(joint.parent).second) grown = true;
    }
  }
  return result;
}

}  // namespace

void check_urdf(const std::string& xml, const std::string& label, const WarningSink& warn) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.c_str(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(label + ":" + std::to_string(document.ErrorLineNum()) +
                ": URDF is not well-formed XML: " + document.ErrorStr());
  }
  const auto* robot = document.FirstChildElement("robot");
  if (robot == nullptr) throw Error(label + ": URDF has no <robot> element");
  tell_ignored_elements(*robot, label, warn);
  std::set<std::string> with_inertia;
  std::vector<const tinyxml2::XMLElement*> without;
  for (auto* link = robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    const char* name = link->Attribute("name");
    if (name == nullptr) {
      throw Error(label + ":" + std::to_string(link->GetLineNum()) + ": link without a name");
    }
    const auto* inertial = link->FirstChildElement("inertial");
    if (inertial == nullptr) {
      without.push_back(link);
      continue;
    }
    check_inertial(*inertial, place(label, *inertial, name));
    with_inertia.insert(name);
  }
  const std::vector<JointEnds> joints = read_joints(*robot);
  const std::set<std::string> carried = carried_inertia(joints, with_inertia);
  const std::set<std::string> frames = mere_frames(joints, with_inertia);
  for (const auto* link : without) {
    const std::string name = link->Attribute("name");
    if (carried.count(name) + frames.count(name) != 0 || name == "world") continue;
    warn(place(label, *link, name) +
         " has no <inertial>: it is not simulated, nor is what hangs on it (SDF conversion drops "
         "it)");
  }
}

}  // namespace trident
