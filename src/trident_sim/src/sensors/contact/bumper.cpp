// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/plugins/model_params.h"
#include "core/plugins/plugin_util.h"
#include "trident_base/error.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// The geometry of a collision of the sensor's link. Throws Error that lists those it has.
Geom& find_geometry(const PluginContext& context, const std::string& name) {
  const std::string prefix = context.model->name + "::" + context.link->name + "::";
  std::string known;
  for (Geom* const geom : context.model->collision_shapes(*context.link)) {
    const std::string& scoped_name = geom->scoped_name();
    if (scoped_name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string own = scoped_name.substr(prefix.size());
    if (own == name || scoped_name == name) return *geom;
    known += (known.empty() ? "" : ", ") + own;
  }
  throw Error(context.params.owner() + ": <collision> is '" + name +
              "', expected a collision of link '" + context.link->name +
              "': " + (known.empty() ? "it has none" : known));
}

std::vector<Geom*> find_geometries(const PluginContext& context) {
  if (context.sensor == nullptr) {
    throw Error(context.params.owner() + ": belongs in a <sensor> of type contact");
  }
  std::vector<Geom*> geoms;
  if (const ParamNode* const contact = context.sensor->params.find("contact")) {
    for (const ParamNode& child : contact->children) {
      if (child.name == "collision") geoms.push_back(&find_geometry(context, child.text));
    }
  }
  if (geoms.empty()) {
    throw Error(context.params.owner() + ": <contact> with a <collision> is missing in its sensor");
  }
  return geoms;
}

/// libgazebo_ros_bumper.so: what the collisions of a contact sensor touch, at the sensor's rate and
/// also while they touch nothing. <bumperTopicName> (bumper_states), <frameName> (world), which is
/// only published: positions, normals and wrenches are those of the world, as upstream. Collision 1
/// is the sensor's own; torques are about its body's centre of mass.
class Bumper : public Plugin {
 public:
  explicit Bumper(const PluginContext& context)
      : geoms_(find_geometries(context)), clock_(context.sensor->update_rate_hz) {
    const PluginParams& params = context.params;
    states_ = advertise<ContactsSample>(
        context, scoped_topic(params, params.text("bumperTopicName", "bumper_states")),
        PortRank::kSensor);
    states_->value.frame =
        resolved_frame(context, params.text("frameName", "world"), FramePrefix::kTfPrefix);
  }

  std::vector<Phase> phases() const override { return {Phase::kSense, Phase::kPost}; }
  /// Before the step that is to be published, so that nobody pays for contacts that nobody reads.
  void pre_step(Phase, World&, const StepInfo& info) override {
    const bool is_watching = states_->wanted() && clock_.is_due(info);
    if (is_watching == is_watching_) return;
    is_watching_ = is_watching;
    for (Geom* geom : geoms_) is_watching ? geom->add_watcher() : geom->remove_watcher();
  }
  void post_step(const World& world, const StepInfo& info) override {
    if (!is_watching_) return;
    ContactsSample& value = states_->value;
    value.stamp = info.end;
    value.touches.clear();
    for (const Contact& contact : world.contacts()) {
      if (is_own(contact.geom1)) {
        add(contact, *contact.geom1, *contact.geom2, 1.0, contact.p_world_center1);
      } else if (is_own(contact.geom2)) {
        add(contact, *contact.geom2, *contact.geom1, -1.0, contact.p_world_center2);
      }
    }
    states_->publish();
  }

 private:
  bool is_own(const Geom* geom) const {
    return std::find(geoms_.begin(), geoms_.end(), geom) != geoms_.end();
  }

  /// `sign`: -1 when the contact holds the force on the other one.
  void add(const Contact& contact, const Geom& own, const Geom& other, double sign,
           const Eigen::Vector3d& p_world_center) {
    std::vector<TouchSample>& touches = states_->value.touches;
    const auto is_pair = [&](const TouchSample& touch) {
      return touch.collision1 == own.scoped_name() && touch.collision2 == other.scoped_name();
    };
    auto touch = std::find_if(touches.begin(), touches.end(), is_pair);
    if (touch == touches.end()) {
      touches.emplace_back();
      touch = std::prev(touches.end());
      touch->collision1 = own.scoped_name();
      touch->collision2 = other.scoped_name();
    }
    const Eigen::Vector3d force = sign * contact.force_world;
    touch->positions.push_back(contact.p_world);
    touch->normals.emplace_back(sign * contact.normal_world);
    touch->forces.push_back(force);
    touch->torques.emplace_back((contact.p_world - p_world_center).cross(force));
    touch->depths.push_back(contact.depth_m);
  }

  std::vector<Geom*> geoms_;
  SampleClock clock_;
  bool is_watching_ = false;
  OutHandle<ContactsSample> states_;
};

constexpr const char* kExampleSensor =
    R"(<sensor name="example" type="contact"><update_rate>50</update_rate>
    <contact><collision>collision</collision></contact></sensor>)";
const PluginRegistrar kGazeboRosBumper("libgazebo_ros_bumper.so", factory_of<Bumper>(),
                                       PluginExample{"", {}, {}, kExampleSensor});

}  // namespace

}  // namespace trident::sim
