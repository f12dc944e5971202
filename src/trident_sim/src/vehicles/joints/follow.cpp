// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/plugins/plugin_util.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// libtrident_follow.so: carries its model along with another one, without turning it. <followed>
/// is that model, <offset> where this one's origin is kept, seen from the other's [m, world axes].
/// A static model may be carried, too: one that has no shapes, as nothing else would notice. While
/// the other model is not there this one stays where it is.
class Follow : public Plugin {
 public:
  explicit Follow(const PluginContext& context)
      : model_(*context.model),
        followed_(context.params.required_text("followed")),
        offset_(context.params.vector3("offset", Eigen::Vector3d::Zero())) {
    if (followed_ == model_.name) {
      context.params.refuse("followed", followed_, "another model than its own");
    }
    for (const LinkSpec& link : model_.spec.links) {
      if (model_.is_static && !(link.collisions.empty() && link.visuals.empty())) {
        context.params.refuse("followed", followed_, "without it: a static model with shapes");
      }
    }
  }

  std::vector<Phase> phases() const override { return {Phase::kSense}; }

  void pre_step(Phase, World& world, const StepInfo&) override {
    const Model* const followed = world.find_model(followed_);
    if (followed == nullptr) return;
    const Eigen::Vector3d target = followed->T_world_model().p + offset_;
    const SE3 T_world_model = model_.T_world_model();
    if (!model_.is_static) {
      world.set_model_pose(model_, {T_world_model.R, target});
      world.set_model_twist(model_, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    } else {
      shift(target - T_world_model.p);
    }
  }

  void reset() override {
    if (model_.is_static) shift(-shifted_);
  }
  void state(StateArchive& archive) override {
    Eigen::Vector3d shifted = shifted_;
    archive(shifted);
    if (model_.is_static) shift(shifted - shifted_);
  }

 private:
  void shift(const Eigen::Vector3d& by) {
    shifted_ += by;
    for (const auto& link : model_.links) link->T_body_link.p += by;
  }

  Model& model_;
  std::string followed_;
  Eigen::Vector3d offset_;
  Eigen::Vector3d shifted_ = Eigen::Vector3d::Zero();  ///< a static model, since it was spawned
};

const PluginRegistrar kTridentFollow("libtrident_follow.so", factory_of<Follow>());

}  // namespace

}  // namespace trident::sim
