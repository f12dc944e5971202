// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>
#include <vector>

#include "recoveries.h"
#include "trident_base/config_types.h"
#include "trident_base/string_util.h"

namespace trident::nav {

constexpr auto enum_names(AffectedMaps /*maps*/) {
  return std::array{EnumName<AffectedMaps>{AffectedMaps::kBoth, "both"},
                    EnumName<AffectedMaps>{AffectedMaps::kGlobal, "global"},
                    EnumName<AffectedMaps>{AffectedMaps::kLocal, "local"}};
}

namespace {

/// Names of clear_costmap_recovery; there `layer_names` is [obstacles], which clears nothing where
/// a layer has another name.
struct ClearCostmapParams {
  double reset_distance = 3.0;
  bool invert_area_to_clear = false;
  bool force_updating = false;
  AffectedMaps affected_maps = AffectedMaps::kBoth;
  std::vector<std::string> layer_names;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("reset_distance", reset_distance, Range::non_negative(),
             "side of a square about the robot [m]");
    ar.field("invert_area_to_clear", invert_area_to_clear,
             "what lies in the square is cleared, not what lies outside");
    ar.field("force_updating", force_updating, "accepted: costmaps are always updated afterwards");
    ar.field("affected_maps", affected_maps, "which costmaps are cleared");
    ar.field("layer_names", layer_names, "layers that are cleared; none: all but static ones");
  }
};

/// Lets costmaps forget what is not seen any more.
class ClearCostmap : public Recovery {
 public:
  explicit ClearCostmap(const ClearCostmapParams& params) : params_(params) {}

  RecoveryStep step(const RecoverySituation& situation) override {
    const bool inside = params_.invert_area_to_clear;
    situation.world.forget({params_.reset_distance,
                            inside ? Layer::Side::kInside : Layer::Side::kOutside,
                            params_.affected_maps, params_.layer_names});
    return {{},
            true,
            std::string("What was sensed ") + (inside ? "within" : "outside of") + " a square of " +
                number_text(params_.reset_distance) + " m about the robot was forgotten."};
  }

 private:
  ClearCostmapParams params_;
};

}  // namespace

void add_clear_costmap(RecoveryRegistry& registry) {
  registry.add("clear_costmap_recovery/ClearCostmapRecovery",
               [](const RecoverySetup&, const ConfigNode& parameters, const std::string& source) {
                 return std::make_unique<ClearCostmap>(
                     load_config_node<ClearCostmapParams>(parameters, source));
               });
}

}  // namespace trident::nav
