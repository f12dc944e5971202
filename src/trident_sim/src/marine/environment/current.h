// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "core/environment/wind_field.h"
#include "marine/vessel/hull.h"
#include "trident_base/se3.h"
#include "trident_base/yaml_config.h"

namespace trident::sim {

enum class CurrentKind { kNone, kUniform, kShear, kVortex, kFile };
constexpr auto enum_names(CurrentKind) {
  return std::array{EnumName{CurrentKind::kNone, "none"},
                    EnumName{CurrentKind::kUniform, "uniform"},
                    EnumName{CurrentKind::kShear, "shear"},
                    EnumName{CurrentKind::kVortex, "vortex"}, EnumName{CurrentKind::kFile, "file"}};
}

/// All kinds but kVortex and kFile flow towards `direction` with `speed`, at the origin of kShear.
/// kVortex: Lamb-Oseen's, which turns fastest, with `speed`, at the core's radius.
struct CurrentParams {
  CurrentKind kind = CurrentKind::kNone;
  double speed = 0.0;
  double direction = 0.0;
  double shear = 0.0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double core_radius = 20.0;
  std::string file;
  double tide_amplitude = 0.0;
  double tide_period = 44712.0;
  double tide_phase = 0.0;
  double shore_depth = 1.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("kind", kind, "of the flow");
    ar.field("speed", speed, Range{-10.0, 10.0}, "[m/s]; vortex: > 0 turns counter-clockwise");
    ar.field("direction", direction, Range{-6.3, 6.3}, "it flows to, from x towards y [rad]");
    ar.field("shear", shear, Range{-1.0, 1.0}, "change of speed per metre to the left [1/s]");
    ar.field("center", center, "of the vortex [m]");
    ar.field("core_radius", core_radius, Range::positive(), "of the vortex [m]");
    ar.field("file", file, "a grid in the format of RotorS' wind fields");
    ar.field("tide_amplitude", tide_amplitude, Range{0.0, 10.0},
             "the flow is multiplied by 1 + tide_amplitude sin(2 pi t / tide_period + tide_phase)");
    ar.field("tide_period", tide_period, Range::positive(), "[s]");
    ar.field("tide_phase", tide_phase, Range{-6.3, 6.3}, "[rad]");
    ar.field("shore_depth", shore_depth, Range::positive(),
             "where a bathymetry is nearer the flow fades, to none on land [m]");
  }
  /// Throws Error: kind file without a file.
  void validate() const;
};

/// The water's flow but for waves, as a function of place and time.
class Current {
 public:
  /// Depth of the still water at a place and time [m]; negative on land.
  using WaterDepth = std::function<double(const Eigen::Vector2d& p_world, double time_s)>;
  /// Reads the file of kind file. Throws Error naming file, line and value. Without `water_depth`
  /// there is water everywhere.
  explicit Current(const CurrentParams& params, WaterDepth water_depth = {});

  /// [m/s], world frame; nothing outside of a file's grid.
  Eigen::Vector3d velocity(const Eigen::Vector3d& p_world, double time_s) const;
  /// How fast the flow changes for who moves through it with `v_world` [m/s^2].
  Eigen::Vector3d rate(const Eigen::Vector3d& p_world, const Eigen::Vector3d& v_world,
                       double time_s) const;
  /// Adds the flow at CO to the water that flows against a hull.
  void add_to(const SE3& T_world_co, const Eigen::Vector3d& v_world, double time_s,
              HullWater* water) const;

 private:
  Eigen::Vector3d steady(const Eigen::Vector3d& p_world) const;

  CurrentParams params_;
  std::shared_ptr<const WindGrid> grid_;
  WaterDepth water_depth_;
};

}  // namespace trident::sim
