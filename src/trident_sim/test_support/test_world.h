// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/se3.h"
#include "trident_sim/world.h"

namespace trident::sim {

struct Report {
  Severity severity;
  std::string text;
};

/// An empty world with step `dt_s`, gravity (0, 0, -9.8) and ODE's exact solver.
WorldSpec world_spec(double dt_s = 0.01);

/// The same without gravity.
WorldSpec weightless(double dt_s = 0.001);

WorldOptions with_timing(LoopTiming timing);

/// A world of plain specs with all built-in plugins, which keeps its reports.
class TestWorld {
 public:
  explicit TestWorld(const WorldSpec& spec = world_spec(), WorldOptions options = {},
                     const Resources& resources = Resources());

  World& operator*() { return world_; }
  World* operator->() { return &world_; }

  /// Spawns and returns the model.
  Model& add(ModelSpec spec) { return world_.spawn(std::move(spec), ""); }
  /// Reports that contain `fragment`.
  std::size_t report_count(Severity severity, const std::string& fragment) const;

  PluginRegistry registry;
  std::vector<Report> reports;

 private:
  WorldOptions listening(WorldOptions options);
  World world_;
};

/// Runs `action`, which must throw Error, and returns its text; "" and a failure otherwise.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return "";
}

testing::AssertionResult contains(const std::string& text, const std::string& fragment);
testing::AssertionResult is_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 double tolerance);
/// Both the distance of the origins [m] and the angle between [rad] are within `tolerance`.
testing::AssertionResult is_near(const SE3& a, const SE3& b, double tolerance);

inline SE3 at(double x, double y, double z) { return SE3::from_xyz_rpy({x, y, z}, 0.0, 0.0, 0.0); }

}  // namespace trident::sim
