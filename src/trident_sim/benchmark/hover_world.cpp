// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "hover_world.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>

#include "trident_base/error.h"
#include "trident_control_sim/lee_plugin.h"

namespace trident::sim {
namespace {

constexpr int kPerRow = 10;
constexpr double kSpacing_m = 2.0;
constexpr double kSpawnHeight_m = 0.1;
constexpr double kHoverHeight_m = 1.0;
constexpr int kTakeOffLimit_s = 30;

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error("file '" + path + "' does not exist or cannot be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

/// The vehicle's description with the controller as its last plugin: it reads the odometry's port.
std::string with_controller(const std::string& urdf, const std::string& ns,
                            const BenchmarkOptions& options) {
  std::string text = replaced(urdf, options.marker, ns);
  const std::size_t end = text.rfind("</robot>");
  if (end == std::string::npos) throw Error("file '" + options.urdf_file + "' has no </robot>");
  text.insert(end,
              "<gazebo><plugin filename='libtrident_lee_position_controller.so' name='controller'>"
              "<robotNamespace>" +
                  ns + "</robotNamespace><parameterFiles>" + options.parameters +
                  "</parameterFiles></plugin></gazebo>");
  return text;
}

}  // namespace

HoverWorld::HoverWorld(const BenchmarkOptions& options) {
  register_builtin_plugins(registry_);
  control::register_control_plugins(registry_);
  const auto warn = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
  WorldOptions world_options;
  world_options.report = [](Severity, const std::string& text) {
    std::fprintf(stderr, "%s\n", text.c_str());
  };
  world_ = std::make_unique<World>(load_world_file(options.world_file, resources_, warn),
                                   resources_, registry_, world_options);
  const std::string urdf = read_file(options.urdf_file);
  if (urdf.find(options.marker) == std::string::npos) {
    throw Error("file '" + options.urdf_file + "' does not contain the marker '" + options.marker +
                "'");
  }
  for (int i = 0; i < options.vehicles; ++i) spawn_vehicle(i, urdf, options);
}

void HoverWorld::spawn_vehicle(int index, const std::string& urdf,
                               const BenchmarkOptions& options) {
  const std::string ns = "UAV" + std::to_string(index + 1);
  SE3 T_world_model;
  T_world_model.p = {kSpacing_m * (index % kPerRow), kSpacing_m * (index / kPerRow),
                     kSpawnHeight_m};
  world_->spawn({ns, with_controller(urdf, ns, options), "", ns, T_world_model});
  auto* setpoint = world_->ports().find_in<control::TrajectorySample>(ns + "/command/trajectory");
  if (setpoint == nullptr) throw Error("vehicle " + ns + " has no port command/trajectory");
  control::TimedSetpoint hover;
  hover.point.p_world = {T_world_model.p.x(), T_world_model.p.y(), kHoverHeight_m};
  setpoint->write({SimTime{}, {hover}});
  p_world_goal_[ns] = hover.point.p_world;
}

void HoverWorld::step_seconds(double seconds) {
  world_->step(static_cast<std::uint64_t>(std::llround(seconds / world_->dt().seconds())));
}

void HoverWorld::take_off(double z_m) {
  for (int second = 0; second < kTakeOffLimit_s; ++second) {
    step_seconds(1.0);
    if (lowest_z_m() > z_m) return;
  }
  throw Error("after " + std::to_string(kTakeOffLimit_s) + " s the lowest vehicle is at z = " +
              std::to_string(lowest_z_m()) + " m, must be above " + std::to_string(z_m) + " m");
}

double HoverWorld::lowest_z_m() const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& [name, p_goal] : p_world_goal_) {
    lowest = std::min(lowest, world_->find_model(name)->T_world_model().p.z());
  }
  return lowest;
}

double HoverWorld::largest_offset_m() const {
  double largest = 0.0;
  for (const auto& [name, p_goal] : p_world_goal_) {
    largest = std::max(largest, (world_->find_model(name)->T_world_model().p - p_goal).norm());
  }
  return largest;
}

}  // namespace trident::sim
