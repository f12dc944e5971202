// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "trident_sim/diagnostics.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {

/// How measurements and commands are delayed.
enum class LoopTiming {
  /// As RotorS on Gazebo: state k is measured as step k+1 begins and stamped (k+1) dt; the command
  /// computed from it moves the motors as step k+3 begins.
  kRotors,
  /// No artificial delay: state k is measured as step k ends and stamped k dt; the command computed
  /// from it acts in step k+1.
  kDirect
};

/// Where the world reports problems that do not stop it. One call per event.
using ReportSink = std::function<void(Severity, const std::string&)>;

/// What a world is made with besides its file. Everything that a run depends on is here or in the
/// file, so that equal options and commands give equal runs.
struct WorldOptions {
  std::uint64_t seed = 0;  ///< of all noise; each plugin draws from a stream of its own name
  /// Acts on plugins as they are made, and cannot change afterwards
  LoopTiming timing = LoopTiming::kRotors;
  ReportSink report;  ///< called by the thread that steps or spawns; empty: dropped
  /// What names of frames begin with in a robot's namespace (ROS' parameter tf_prefix); none: "".
  std::function<std::string(const std::string& robot_namespace)> tf_prefix{};
  /// Threads that share the work of lidars and cameras, 1 to 256. Results do not depend on it.
  std::size_t sensor_threads = 1;
  /// Where the first of what diagnostics() keeps is reported; none: to `report`.
  ReportSink diagnosed{};
  /// What is done with models, collisions and plugins that cannot be made.
  OddElements odd_elements = OddElements::kRefuse;
};

/// What a world is for its whole life: its name, its place on the Earth, how it looks, and what it
/// was made with.
class WorldSetting {
 public:
  /// WorldOptions::seed. A plugin makes its RandomStream of it and of PluginContext::name.
  std::uint64_t seed() const { return options_.seed; }
  /// WorldOptions::timing, fixed for the world's life
  LoopTiming timing() const { return options_.timing; }
  /// What the frame names of robots in this namespace begin with; "" without
  /// WorldOptions::tf_prefix.
  std::string tf_prefix(const std::string& robot_namespace) const {
    return options_.tf_prefix ? options_.tf_prefix(robot_namespace) : "";
  }
  const std::string& name() const { return name_; }  ///< as in the world file
  /// Where plugins find the files that their parameters name.
  const Resources& resources() const { return resources_; }
  /// Where on the Earth the world's origin lies, for GNSS receivers and magnetometers.
  const SphericalCoordinates& spherical() const { return spherical_; }
  const SceneSpec& scene() const { return scene_; }  ///< for cameras: ambient light and background
  /// Of the world file, in its order
  const std::vector<LightSpec>& lights() const { return lights_; }

 protected:
  WorldSetting(const WorldSpec& spec, const Resources& resources, WorldOptions options)
      : name_(spec.name),
        spherical_(spec.spherical),
        scene_(spec.scene),
        lights_(spec.lights),
        resources_(resources),
        options_(std::move(options)) {}
  ~WorldSetting() = default;

  std::string name_;
  SphericalCoordinates spherical_;
  SceneSpec scene_;
  std::vector<LightSpec> lights_;
  Resources resources_;
  WorldOptions options_;
};

}  // namespace trident::sim
