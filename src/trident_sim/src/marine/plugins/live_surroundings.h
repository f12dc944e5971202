// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "marine/environment/environment.h"
#include "trident_base/string_util.h"
#include "trident_sim/sea.h"

namespace trident::sim {

/// Sea and air as they are now: one object for as long as the world lasts, in which commands put
/// another environment. Its plugin changes it between steps only.
class LiveSurroundings : public Sea, public Air {
 public:
  LiveSurroundings(std::shared_ptr<const Environment> now, Wind now_blowing)
      : environment(std::move(now)), blowing(std::move(now_blowing)) {}

  const Water& water() const override { return environment->water(); }
  const Current& current() const override { return environment->current(); }
  double depth_m(const Eigen::Vector2d& p_world, double time_s) const override {
    return environment->depth_m(p_world, time_s);
  }
  double still_level_m(double time_s) const override { return environment->still_level_m(time_s); }
  double significant_height_m() const override { return environment->significant_height_m(); }
  Eigen::Vector3d wind(const Eigen::Vector3d& p_world) const override {
    return blowing.velocity(p_world);
  }
  bool blows() const override { return blowing.params().blows(); }
  std::string state_text() const override {
    std::string result = text;
    const Eigen::Vector3d v = blowing.velocity(Eigen::Vector3d::Zero());
    for (int i = 0; i < 3; ++i) result += " " + number_text(v[i]);
    return result;
  }

  std::shared_ptr<const Environment> environment;
  Wind blowing;
  std::string text;  ///< what the environment is, as YAML
};

}  // namespace trident::sim
