// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_sim/samples.h"
#include "trident_sim/topic_names.h"
#include "trident_sim/world.h"
#include "trident_sim/world/link_motion.h"

namespace trident::sim {

/// "<robotNamespace>/<topic>" without doubled or outer slashes; an absolute topic stands alone.
std::string scoped_topic(const PluginParams& params, const std::string& topic);

/// The link that `key` names, with or without a leading slash. Throws Error with the known ones.
Link& required_link(const PluginContext& context, const std::string& key);
/// The link that the plugin stands in, else the one that <linkName> names, else the model's
/// canonical one. Throws Error for a model without links.
Link& own_link(const PluginContext& context);
Joint& required_joint(const PluginContext& context, const std::string& key);
/// The joint that `key` names, or the one of the name `fallback`.
Joint& joint_or(const PluginContext& context, const std::string& key, const std::string& fallback);
/// The joints that <jointName> lists, separated by commas or blanks; each has the axes, at least.
std::vector<Joint*> listed_joints(const PluginContext& context, std::size_t least_axes = 0);

template <class T>
OutHandle<T> advertise(const PluginContext& context, const std::string& name, PortRank rank) {
  PortBoard& board = context.world.ports();
  return {board, board.advertise<T>(name, rank)};
}
template <class T>
InHandle<T> subscribe(const PluginContext& context, const std::string& name) {
  PortBoard& board = context.world.ports();
  return {board, board.subscribe<T>(name)};
}

/// The transform of `child` in `parent`. Empty, and reported, when another plugin gives that of
/// `child` already: a frame has one parent.
OutHandle<FrameSample> advertise_frame(const PluginContext& context, const std::string& parent,
                                       const std::string& child);

/// A plugin that measures once per step: as the step begins in `rotors` timing, as it ends in
/// `direct`. The stamp is the end of the step in both (see LoopTiming).
class MeasuringPlugin : public Plugin {
 public:
  explicit MeasuringPlugin(LoopTiming timing) : timing_(timing) {}
  std::vector<Phase> phases() const final {
    return {timing_ == LoopTiming::kRotors ? Phase::kSense : Phase::kPost};
  }
  void pre_step(Phase, World& world, const StepInfo& info) final { measure(world, info); }
  void post_step(const World& world, const StepInfo& info) final { measure(world, info); }

 protected:
  virtual void measure(const World& world, const StepInfo& info) = 0;

 private:
  LoopTiming timing_;
};

}  // namespace trident::sim
