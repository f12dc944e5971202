// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>

namespace trident::sim {

class Current;
class Water;
class World;

/// The sea of a world: water that waves move, and its flow besides (src/marine). Both are pure
/// functions of place and time, so that it does not matter who asks, how often and in which order.
/// A command may change the sea as a step begins: ask water() and current() again in every step.
class Sea {
 public:
  virtual ~Sea() = default;
  virtual const Water& water() const = 0;      ///< surface and its motion; valid within the step
  virtual const Current& current() const = 0;  ///< flow of the water; valid within the step
  /// Of the still water above the ground there, by the tide at that time; negative on land,
  /// infinite where no ground is known [m].
  virtual double depth_m(const Eigen::Vector2d& p_world, double time_s) const = 0;
  /// z of the surface without its waves, by the tide at that time [m].
  virtual double still_level_m(double /*time_s*/) const { return 0.0; }
  virtual double significant_height_m() const { return 0.0; }  ///< of its waves, Hs [m]
  /// What the sea is like now, for World::state_hash().
  virtual std::string state_text() const { return ""; }  ///< as Sea::state_text()
};

/// The air of a world, which moves vessels and aircraft.
class Air {
 public:
  virtual ~Air() = default;
  /// With its gusts of this step [m/s], world frame.
  virtual Eigen::Vector3d wind(const Eigen::Vector3d& p_world) const = 0;
  /// Whether there is a wind at all. Without wind vessels do not feel the air, so that their
  /// paths in a current are those in still water.
  virtual bool blows() const { return true; }
  virtual std::string state_text() const { return ""; }
};

/// How the plugin that makes a world's sea hands it to those that float: on the output port
/// kSeaPort, which is no topic. A world has one sea.
struct SeaSample {
  std::shared_ptr<const Sea> sea;  ///< lives as long as its plugin, or its last holder
};
constexpr const char* kSeaPort = "world/sea";  ///< name of the port that carries a SeaSample
/// The same of the air.
struct AirSample {
  std::shared_ptr<const Air> air;  ///< lives as long as its plugin, or its last holder
};
constexpr const char* kAirPort = "world/air";  ///< name of the port that carries an AirSample

/// nullptr: the world has none.
std::shared_ptr<const Sea> find_sea(const World& world);
/// nullptr: no plugin makes wind, and the air stands still.
std::shared_ptr<const Air> find_air(const World& world);

/// A world's sea and air, looked for again whenever plugins came or went.
class Surroundings {
 public:
  /// To be called at the beginning of each step. Costs a comparison unless ports came or went.
  void look(const World& world);
  const Sea* sea() const { return sea_.get(); }  ///< nullptr: the world has none
  const Air* air() const { return air_.get(); }  ///< nullptr: the world has none

 private:
  std::shared_ptr<const Sea> sea_;
  std::shared_ptr<const Air> air_;
  std::uint64_t ports_version_ = ~std::uint64_t{0};
};

}  // namespace trident::sim
