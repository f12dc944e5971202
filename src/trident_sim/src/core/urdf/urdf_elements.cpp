// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "urdf_elements.h"

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace trident::sim {
namespace {

using tinyxml2::XMLElement;
using Names = std::set<std::string>;

// Among them what others than a simulator read, as Gazebo leaves it to them: transmissions of
// ros_control (whose plugin is reported), mimic, safety and calibration of joints.
const Names kInRobot{"link", "joint", "material", "gazebo", "transmission"};
const Names kInLink{"inertial", "visual", "collision"};
const Names kInJoint{"origin",     "parent",   "child", "axis",
                     "limit",      "dynamics", "mimic", "safety_controller",
                     "calibration"};
/// <gazebo> extensions that libsdformat knows, and elements of SDF that it copies.
const Names kInGazebo{"material",
                      "static",
                      "turnGravityOff",
                      "dampingFactor",
                      "maxVel",
                      "minDepth",
                      "mu1",
                      "mu2",
                      "fdir1",
                      "kp",
                      "kd",
                      "selfCollide",
                      "maxContacts",
                      "laserRetro",
                      "springReference",
                      "springStiffness",
                      "stopCfm",
                      "stopErp",
                      "fudgeFactor",
                      "provideFeedback",
                      "implicitSpringDamper",
                      "cfmDamping",
                      "disableFixedJointLumping",
                      "preserveFixedJoint",
                      "gravity",
                      "self_collide",
                      "kinematic",
                      "velocity_decay",
                      "pose",
                      "visual",
                      "collision",
                      "sensor",
                      "light",
                      "plugin",
                      "joint",
                      "link",
                      "frame",
                      "axis",
                      "physics",
                      "allow_auto_disable",
                      "enable_wind"};

/// Elements by where they are and their name, in the order of their first.
class Ignored {
 public:
  void look_at(const XMLElement& parent, const Names& known, const std::string& where) {
    for (auto* child = parent.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (known.count(child->Name()) > 0) continue;
      const std::string what = "<" + std::string(child->Name()) + "> in " + where;
      if (counts_[what]++ == 0) order_.emplace_back(what, child->GetLineNum());
    }
  }
  void report(const std::string& label, const WarningSink& warn) const {
    for (const auto& [what, line] : order_) {
      const int count = counts_.at(what);
      std::string text = label + ":" + std::to_string(line) + ": ";
      text.append(what);
      if (count > 1) text.append(" (").append(std::to_string(count)).append(" times)");
      warn(text.append(" has no effect here"));
    }
  }

 private:
  std::map<std::string, int> counts_;
  std::vector<std::pair<std::string, int>> order_;
};

void look_at_all(const XMLElement& robot, const char* name, const Names& known, Ignored& ignored) {
  for (auto* element = robot.FirstChildElement(name); element != nullptr;
       element = element->NextSiblingElement(name)) {
    ignored.look_at(*element, known, "<" + std::string(name) + ">");
  }
}

}  // namespace

void report_ignored_elements(const XMLElement& robot, const std::string& label,
                             const WarningSink& warn) {
  Ignored ignored;
  ignored.look_at(robot, kInRobot, "<robot>");
  look_at_all(robot, "link", kInLink, ignored);
  look_at_all(robot, "joint", kInJoint, ignored);
  look_at_all(robot, "gazebo", kInGazebo, ignored);
  ignored.report(label, warn);
}

}  // namespace trident::sim
