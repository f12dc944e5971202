// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "trident_sim/plugin_registry.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

using Names = std::array<const char*, 6>;
constexpr Names kAddedMass{"xDotU", "yDotV", "zDotW", "kDotP", "mDotQ", "nDotR"};
constexpr Names kLinear{"xU", "yV", "zW", "kP", "mQ", "nR"};
constexpr Names kQuadratic{"xUU", "yVV", "zWW", "kPP", "mQQ", "nRR"};

Vector6d read_diagonal(const PluginParams& params, const Names& names, const Vector6d& fallback) {
  Vector6d diagonal;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    diagonal[row] = params.number(names[i], fallback[row], {0.0, 1e9});
  }
  return diagonal;
}

/// Two lying cylinders, whose keels lie in the plane z = 0 of the link. VRX takes only what is
/// below their axes for hull.
HullParams read_hull(const PluginParams& params) {
  const Limits lengths{1e-3, 1e3};
  const double radius = params.number("hullRadius", 0.213, lengths);
  const double width = params.number("boatWidth", 1.0, lengths);
  const double length = params.number("boatLength", 1.35, lengths);
  const int count = params.integer("length_n", 2, {1.0, 1000.0});
  HullParams hull;
  hull.offsets = {0.5 * width, -0.5 * width};
  HullSection section;
  section.shape = SectionShape::kCircle;
  section.length = length / count;
  section.breadth = 2.0 * radius;
  for (int i = 0; i < count; ++i) {
    section.x = (i + 0.5) * section.length - 0.5 * length;
    hull.sections.push_back(section);
  }
  return hull;
}

/// Immerses the sections so far that they carry the mass level, at most to their axes.
double set_draft(double mass_kg, double water_density, HullParams* hull) {
  const double radius = 0.5 * hull->sections.front().breadth;
  const auto carried_kg = [&](double draft) {
    double volume = 0.0;
    for (HullSection& section : hull->sections) {
      section.draft = draft;
      section.freeboard = radius - draft;
      volume += section.length * immersion(section, draft).area_m2;
    }
    return water_density * volume * static_cast<double>(hull->offsets.size());
  };
  constexpr int kHalvings = 60;
  double low = 1e-3 * radius, high = radius;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (carried_kg(middle) < mass_kg ? low : high) = middle;
  }
  carried_kg(high);
  return high;
}

struct UsvParams {
  VesselParams vessel;
  VesselBody::Place place;
};

UsvParams read_usv(const PluginContext& context, const Link& link) {
  const PluginParams& params = context.params;
  UsvParams usv;
  VesselParams& vessel = usv.vessel;
  vessel.name = context.model->name;
  vessel.equation =
      params.flag("legacy_vrx", false) ? VesselEquation::kLegacyVrx : VesselEquation::kFossen;
  vessel.water_density = params.number("waterDensity", 997.7735, {1.0, 1e5});
  vessel.added_mass =
      read_diagonal(params, kAddedMass, (Vector6d() << 5, 5, .1, .1, .1, 1).finished());
  vessel.linear_damping = read_diagonal(params, kLinear, Vector6d::Constant(20.0));
  vessel.quadratic_damping = read_diagonal(params, kQuadratic, Vector6d::Zero());
  vessel.hull = read_hull(params);
  usv.place.level_m = params.number("waterLevel", 0.5, {-1000.0, 9000.0});
  usv.place.T_link_co.p.z() = set_draft(link.body->mass(), vessel.water_density, &vessel.hull);
  params.node("wave_model");  // VRX' name of the model with its waves; here the world has one sea
  return usv;
}

/// libusv_gazebo_dynamics_plugin.so: VRX' elements, defaults and hull on the link <bodyName>, by
/// default under Fossen's full equation. With <legacy_vrx> true it is VRX' own: added mass by
/// differences of the velocity, no Coriolis forces, and buoyancy of points (VrxHull); else its hull
/// is that of libtrident_vessel.so, sections. <waterLevel> is added to the sea's.
class UsvDynamics : public Plugin, public Floating {
 public:
  explicit UsvDynamics(const PluginContext& context)
      : UsvDynamics(context, moving_link(context, "bodyName")) {}

  std::vector<Phase> phases() const override { return {Phase::kActuate}; }
  void pre_step(Phase, World& world, const StepInfo& info) override {
    body_.push(world, info, body_.sense(world, info), Vector6d::Zero());
  }
  void body_frames_moved() override { body_.body_frames_moved(); }
  void check_afloat(const Sea& sea) const override { body_.check_afloat(sea); }
  void reset() override { body_.reset(); }
  void state(StateArchive& archive) override { body_.state(archive); }

 private:
  UsvDynamics(const PluginContext& context, Link& link)
      : UsvDynamics(context, link, read_usv(context, link)) {}
  UsvDynamics(const PluginContext& context, Link& link, const UsvParams& usv)
      : body_(context, link, usv.vessel, usv.place) {}

  VesselBody body_;
};

const PluginRegistrar kUsvGazeboDynamicsPlugin("libusv_gazebo_dynamics_plugin.so",
                                               factory_of<UsvDynamics>());

}  // namespace

}  // namespace trident::sim
