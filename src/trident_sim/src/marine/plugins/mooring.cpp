// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "trident_sim/plugin_registry.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

/// libtrident_mooring.so: a line without weight from <xyzOffset> [m] of the link <bodyName> to
/// <anchor> [m, world]. Slack up to its <length> [m], beyond it pulls with <stiffness> [N/m] and
/// <damping> [N s/m], and never pushes. Stand it before the vessel's plugin, so that the pull is
/// felt with added mass.
class Mooring : public Plugin {
 public:
  explicit Mooring(const PluginContext& context)
      : link_(moving_link(context, "bodyName")),
        offset_(context.params.vector3("xyzOffset", Eigen::Vector3d::Zero())) {
    const PluginParams& params = context.params;
    params.required_text("anchor");
    anchor_ = params.vector3("anchor", Eigen::Vector3d::Zero());
    params.required_text("length");
    length_m_ = params.number("length", 0.0, {0.0, 1e5});
    stiffness_ = params.number("stiffness", 2000.0, {0.0, 1e7});
    damping_ = params.number("damping", 200.0, {0.0, 1e7});
  }

  std::vector<Phase> phases() const override { return {Phase::kActuate}; }

  void pre_step(Phase, World&, const StepInfo&) override {
    const Eigen::Vector3d fairlead = link_.T_world_link() * offset_;
    const Eigen::Vector3d line = anchor_ - fairlead;
    const double distance = line.norm();
    if (distance <= length_m_ || distance <= 0.0) return;
    const Eigen::Vector3d along = line / distance;
    const double paid_out = -along.dot(link_.v_world_at(fairlead));
    const double pull = stiffness_ * (distance - length_m_) + damping_ * paid_out;
    if (pull > 0.0) link_.body->add_force_at(pull * along, fairlead);
  }

 private:
  Link& link_;
  Eigen::Vector3d offset_, anchor_;
  double length_m_ = 0.0, stiffness_ = 0.0, damping_ = 0.0;
};

const PluginRegistrar kTridentMooring("libtrident_mooring.so", factory_of<Mooring>());

}  // namespace

}  // namespace trident::sim
