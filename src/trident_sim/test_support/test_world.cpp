// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "test_world.h"

#include <algorithm>

namespace trident::sim {

WorldSpec world_spec(double dt_s) {
  WorldSpec spec;
  spec.physics.max_step_size_s = dt_s;
  spec.physics.solver = "world";
  return spec;
}

WorldSpec weightless(double dt_s) {
  WorldSpec spec = world_spec(dt_s);
  spec.physics.gravity.setZero();
  return spec;
}

WorldOptions with_timing(LoopTiming timing) {
  WorldOptions options;
  options.timing = timing;
  return options;
}

TestWorld::TestWorld(const WorldSpec& spec, WorldOptions options, const Resources& resources)
    : world_((register_builtin_plugins(registry), spec), resources, registry,
             listening(std::move(options))) {}

WorldOptions TestWorld::listening(WorldOptions options) {
  options.report = [this](Severity severity, const std::string& text) {
    reports.push_back({severity, text});
  };
  return options;
}

std::size_t TestWorld::report_count(Severity severity, const std::string& fragment) const {
  return static_cast<std::size_t>(
      std::count_if(reports.begin(), reports.end(), [&](const Report& report) {
        return report.severity == severity && report.text.find(fragment) != std::string::npos;
      }));
}

testing::AssertionResult contains(const std::string& text, const std::string& fragment) {
  if (text.find(fragment) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << text << "' does not contain '" << fragment << "'";
}

testing::AssertionResult is_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 double tolerance) {
  if ((a - b).norm() <= tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "(" << a.transpose() << ") and (" << b.transpose() << ") are " << (a - b).norm()
         << " apart, more than " << tolerance;
}

testing::AssertionResult is_near(const SE3& a, const SE3& b, double tolerance) {
  if (auto position = is_near(a.p, b.p, tolerance); !position) return position;
  const double angle = a.R.angularDistance(b.R);
  if (angle <= tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "rotations are " << angle << " rad apart, more than " << tolerance;
}

}  // namespace trident::sim
