// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "marine_files.h"
#include "marine_plugins.h"
#include "vessel_actuators.h"
#include "vessel_body.h"

namespace trident {
namespace {

VesselParams read_vessel(const PluginContext& context) {
  const std::string path = context.params.required_text("vessel");
  const std::string file = existing_file(context, "vessel", path);
  try {
    return load_vessel(file);
  } catch (const ConfigError& error) {
    throw Error(context.params.owner() + ": <vessel>: " + error.what());
  }
}

/// libtrident_vessel.so: the vessel of the file <vessel> (config/vessels) on the link <bodyName>,
/// whose inertial must be the file's within 1 %. CO, amidships in the design waterline, lies at
/// <xyzOffset> (0 0 0) in the link, whose axes are the body's. It takes commands on the topics of
/// ThrusterOnTopics and RudderOnTopic; a thruster without any for <cmdTimeout> s stops (0: never).
class Vessel : public Plugin {
 public:
  explicit Vessel(const PluginContext& context)
      : Vessel(context, moving_link(context, "bodyName"), read_vessel(context)) {}

  std::vector<Phase> phases() const override { return {Phase::kActuate}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    const Afloat now = body_.meet(world, info);
    Vector6d tau = Vector6d::Zero();
    for (ThrusterOnTopics& thruster : thrusters_) {
      thruster.step(world, info);
      tau += thruster.thruster().wrench();
      thruster.publish(info.end);
    }
    for (RudderOnTopic& rudder : rudders_) {
      rudder.step(world, info);
      tau += rudder.rudder().wrench(now.nu_r(), water_density_);
    }
    body_.push(world, info, now, tau);
  }

  void body_frames_moved() override { body_.body_frames_moved(); }

  void reset() override {
    body_.reset();
    for (ThrusterOnTopics& thruster : thrusters_) thruster.reset();
    for (RudderOnTopic& rudder : rudders_) rudder.reset();
  }

  void state(StateArchive& archive) override {
    body_.state(archive);
    for (ThrusterOnTopics& thruster : thrusters_) thruster.state(archive);
    for (RudderOnTopic& rudder : rudders_) rudder.state(archive);
  }

 private:
  Vessel(const PluginContext& context, Link& link, const VesselParams& vessel)
      : water_density_(vessel.water_density), body_(context, link, vessel, place(context.params)) {
    body_.check_inertial();
    const double timeout_s = context.params.number("cmdTimeout", 0.0, {0.0, 1e6});
    for (const ThrusterParams& thruster : vessel.thrusters) {
      thrusters_.emplace_back(context, thruster, timeout_s);
    }
    for (const RudderParams& rudder : vessel.rudders) rudders_.emplace_back(context, rudder);
  }

  static VesselBody::Place place(const PluginParams& params) {
    VesselBody::Place place;
    place.T_link_co.p = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
    return place;
  }

  double water_density_;
  VesselBody body_;
  std::vector<ThrusterOnTopics> thrusters_;
  std::vector<RudderOnTopic> rudders_;
};

}  // namespace

PluginFactory vessel_factory() {
  return {[](const PluginContext& context) { return std::make_unique<Vessel>(context); }, {}};
}

}  // namespace trident
