// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace trident {

class Current;
class Water;
class World;

/// The sea of a world: water that waves move, and its flow besides (src/marine). Both are pure
/// functions of place and time, so that it does not matter who asks, how often and in which order.
class Sea {
 public:
  virtual ~Sea() = default;
  virtual const Water& water() const = 0;
  virtual const Current& current() const = 0;
};

/// How the plugin that makes a world's sea hands it to those that float: on the output port
/// kSeaPort, which is no topic. A world has one sea.
struct SeaSample {
  std::shared_ptr<const Sea> sea;
};
constexpr const char* kSeaPort = "world/sea";

/// nullptr: the world has none.
std::shared_ptr<const Sea> find_sea(const World& world);

}  // namespace trident
