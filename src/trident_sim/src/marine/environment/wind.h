// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/environment/wind_field.h"
#include "trident_base/yaml_config.h"
#include "wind_gusts.h"

namespace trident::sim {

enum class GustKind { kNone, kFirstOrder, kDryden };
constexpr auto enum_names(GustKind) {
  return std::array{EnumName{GustKind::kNone, "none"},
                    EnumName{GustKind::kFirstOrder, "first_order"},
                    EnumName{GustKind::kDryden, "dryden"}};
}

/// A mean wind, the same everywhere or that of a static field, and gusts on top of it.
struct WindParams {
  double speed = 0.0;
  double direction = 0.0;
  std::string file;
  GustKind gusts = GustKind::kNone;
  double gust_deviation = 0.0;
  double gust_time = 2.0;
  double altitude = 10.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("speed", speed, Range{0.0, 60.0}, "mean [m/s]");
    ar.field("direction", direction, Range{-6.3, 6.3}, "it blows to, from x towards y [rad]");
    ar.field("file", file, "static field in RotorS' format; outside of it the mean blows");
    ar.field("gusts", gusts, "on top of it");
    ar.field("gust_deviation", gust_deviation, Range{0.0, 30.0},
             "first_order: standard deviation along the wind [m/s]");
    ar.field("gust_time", gust_time, Range::positive(), "first_order: time constant [s]");
    ar.field("altitude", altitude, Range{3.0, 300.0}, "dryden: above ground [m]");
  }
  bool blows() const {
    const bool is_gusty = gusts == GustKind::kFirstOrder && gust_deviation > 0.0;
    return speed > 0.0 || !file.empty() || is_gusty;
  }
};

/// The air's flow as of a step: a mean by place, and gusts that are the same everywhere.
class Wind {
 public:
  /// Reads a field's file. Throws Error naming file, line and value, or when dt_s is not > 0.
  Wind(const WindParams& params, double dt_s, std::uint64_t seed, const std::string& name);

  const WindParams& params() const { return params_; }
  /// [m/s], world frame.
  Eigen::Vector3d velocity(const Eigen::Vector3d& p_world) const;
  void step();
  void reset();
  /// Continues another's gusts, scaled to its own strength, so that a change does not jump.
  void continue_from(const Wind& other);

  template <class Archive>
  void state(Archive& archive) {
    archive(now_);
    first_order_.state(archive);
    dryden_.state(archive);
  }

 private:
  Eigen::Vector3d gust() const;

  WindParams params_;
  Eigen::Vector3d mean_, left_;
  std::shared_ptr<const WindGrid> field_;
  FirstOrderGusts first_order_;
  DrydenGusts dryden_;
  Eigen::Vector3d now_ = Eigen::Vector3d::Zero();  ///< gust of this step, world frame
};

}  // namespace trident::sim
