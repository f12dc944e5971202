// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <tinyxml2.h>

#include <Eigen/Eigenvalues>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/sdf/principal_moments.h"
#include "core/sdf/xml_cut.h"
#include "trident_base/error.h"
#include "urdf_check.h"
#include "urdf_elements.h"

namespace trident::sim {
namespace {

std::string place(const std::string& label, const tinyxml2::XMLElement& element,
                  const std::string& link) {
  return label + ":" + std::to_string(element.GetLineNum()) + ": link '" + link + "'";
}

/// Of a mass [kg] and of an inertia [kg m^2]; numbers beyond overflow where they are multiplied.
constexpr double kHeaviest = 1e12;

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

/// Its mass [kg]; throws Error for one that cannot be.
void check_mass(const tinyxml2::XMLElement& inertial, const std::string& where) {
  const double mass = attribute(inertial.FirstChildElement("mass"), "value", where);
  if (mass > 0.0 && mass <= kHeaviest) return;
  std::ostringstream text;
  text << where << ": mass is " << mass << " kg, must be > 0 and <= 1e12";
  throw Error(text.str());
}

/// Throws Error for numbers that cannot be read.
Eigen::Matrix3d read_inertia(const tinyxml2::XMLElement& inertial, const std::string& where) {
  const auto* element = inertial.FirstChildElement("inertia");
  const auto at = [&](const char* name) { return attribute(element, name, where); };
  // First all numbers: a refusal amid a matrix' comma list would trip Eigen's check of its length.
  const double xx = at("ixx"), xy = at("ixy"), xz = at("ixz");
  const double yy = at("iyy"), yz = at("iyz"), zz = at("izz");
  Eigen::Matrix3d inertia;
  inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return inertia;
}

/// What is wrong with the inertia, or "".
std::string inertia_fault(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  std::ostringstream text;
  if (!(principal.minCoeff() > 0.0)) {
    text << "inertia is not positive definite (smallest eigenvalue " << principal.minCoeff()
         << " kg m^2, must be > 0)";
  } else if (!(principal.maxCoeff() <= kHeaviest)) {
    text << "principal inertia is " << principal.maxCoeff() << " kg m^2, must be <= 1e12";
  }
  return text.str();
}

/// Throws what is wrong with the mass, or with numbers; of an inertia that cannot be it is noted
/// what is used.
void check_inertial(const tinyxml2::XMLElement& inertial, const std::string& where, OddList& odd) {
  check_mass(inertial, where);
  const Eigen::Matrix3d inertia = read_inertia(inertial, where);
  std::string fault = inertia_fault(inertia);
  const bool is_usable = fault.empty();
  if (is_usable) fault = uneven_moments(inertia);
  if (fault.empty()) return;
  if (odd.policy == OddElements::kRefuse) throw Error(where + ": " + fault);
  odd.texts.push_back(where + ": " + fault + "; " +
                      (is_usable ? kUsedAsItIs
                                 : "counts with what fixed joints join to the link, and if their "
                                   "sum cannot be either, 1 kg m^2 about each axis is used, as in "
                                   "Gazebo"));
}

/// The links of a robot by whether they have an `<inertial>` that can be used.
class LinkMasses {
 public:
  LinkMasses(const std::string& label, OddList& odd) : label_(label), odd_(odd) {}

  void look_at(const tinyxml2::XMLElement& link) {
    const auto* inertial = link.FirstChildElement("inertial");
    if (inertial != nullptr && is_usable(*inertial, link.Attribute("name"))) {
      with.insert(link.Attribute("name"));
    } else {
      without.push_back(&link);
    }
  }
  /// Blanks those whose mass cannot be, so that the conversion does not see them.
  void cut_unusable(std::string& xml) const {
    for (auto it = cuts_.rbegin(); it != cuts_.rend(); ++it) {
      cut_element(xml, it->line, "inertial", it->before);
    }
  }

  std::set<std::string> with;
  std::vector<const tinyxml2::XMLElement*> without;

 private:
  struct Place {
    int line, before;  ///< `before`: of its kind in that line
  };
  bool is_usable(const tinyxml2::XMLElement& inertial, const char* link) {
    const int line = inertial.GetLineNum();
    last_ = {line, line == last_.line ? last_.before + 1 : 0};
    try {
      check_inertial(inertial, place(label_, inertial, link), odd_);
      return true;
    } catch (const Error& error) {
      if (odd_.policy == OddElements::kRefuse) throw;
      odd_.texts.push_back(std::string(error.what()) + "; read as a link without <inertial>");
      cuts_.push_back(last_);
      return false;
    }
  }

  const std::string& label_;
  OddList& odd_;
  Place last_{0, 0};
  std::vector<Place> cuts_;
};

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
/// What holds a frame that holds something holds it, too.
void add_holders_of_frames(const std::vector<JointEnds>& joints,
                           const std::set<std::string>& frames, std::set<std::string>& holders) {
  for (bool grown = true; grown;) {
    grown = false;
    for (const JointEnds& joint : joints) {
      if (frames.count(joint.child) == 0 || holders.count(joint.child) == 0) continue;
      if (holders.insert(joint.parent).second) grown = true;
    }
  }
}

std::set<std::string> mere_frames(const std::vector<JointEnds>& joints,
                                  const std::set<std::string>& with_inertia) {
  std::set<std::string> frames, holders;
  for (const JointEnds& joint : joints) {
    if (joint.fixed && with_inertia.count(joint.child) == 0) frames.insert(joint.child);
    if (!joint.fixed) holders.insert(joint.parent);
  }
  add_holders_of_frames(joints, frames, holders);
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

void report_lost_links(const tinyxml2::XMLElement& robot, const LinkMasses& masses,
                       const std::string& label, const WarningSink& warn) {
  const std::vector<JointEnds> joints = read_joints(robot);
  const std::set<std::string> carried = carried_inertia(joints, masses.with);
  const std::set<std::string> frames = mere_frames(joints, masses.with);
  for (const auto* link : masses.without) {
    const std::string name = link->Attribute("name");
    if (carried.count(name) + frames.count(name) != 0 || name == "world") continue;
    warn(place(label, *link, name) +
         " has no <inertial>: it is not simulated, nor is what hangs on it (SDF conversion drops "
         "it)");
  }
}

}  // namespace

void check_urdf(std::string& xml, const std::string& label, const WarningSink& warn, OddList& odd) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.c_str(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(label + ":" + std::to_string(document.ErrorLineNum()) +
                ": URDF is not well-formed XML: " + document.ErrorStr());
  }
  const auto* robot = document.FirstChildElement("robot");
  if (robot == nullptr) throw Error(label + ": URDF has no <robot> element");
  report_ignored_elements(*robot, label, warn);
  LinkMasses masses(label, odd);
  for (auto* link = robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    if (link->Attribute("name") == nullptr) {
      throw Error(label + ":" + std::to_string(link->GetLineNum()) + ": link without a name");
    }
    masses.look_at(*link);
  }
  masses.cut_unusable(xml);
  report_lost_links(*robot, masses, label, warn);
}

}  // namespace trident::sim
