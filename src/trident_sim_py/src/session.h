// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/se3.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/port.h"
#include "trident_sim/resources.h"
#include "trident_sim/world.h"

namespace trident::sim {

struct SessionOptions {
  std::string world;  ///< path, or the text of an SDF file when it begins with '<'
  std::uint64_t seed = 0;
  std::string timing = "rotors";     ///< or "direct"
  std::vector<std::string> folders;  ///< searched before the environment's paths
  std::vector<std::string> plugins;  ///< shared objects with plugins, besides the built-in ones
  std::size_t sensor_threads = 1;
  bool strict = false;  ///< odd elements of files are refused, not left out
};

/// One event that did not stop the world.
struct Message {
  std::string severity;  ///< "warning" or "error"
  std::string text;
  double time_s = 0.0;
};

/// A world with all that lives as long as it does, for one Python thread at a time. Names, not
/// pointers, are what Python holds: a model that is removed leaves no dangling handle.
class Session {
 public:
  explicit Session(const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Throws Error while another thread steps.
  World& world() const;
  Model& model(const std::string& name);
  Link& link(const std::string& model_name, const std::string& name);
  Joint& joint(const std::string& model_name, const std::string& name);

  /// Returns the model's name.
  std::string spawn(const SpawnRequest& request);
  void remove(const std::string& name);
  /// Steps without the interpreter's lock; looks for Ctrl-C now and then.
  void step(std::uint64_t n);
  /// Calls `work` with the world, marked as in use; the interpreter's lock is not needed.
  void use(const std::function<void(World&)>& work);
  void reset(bool with_time);
  void restore(const Snapshot& snapshot);
  /// How often time has been turned back; what was read before is news again.
  std::uint64_t restore_count() const { return restore_count_; }

  PortBase* find_port(const std::string& name, PortDirection direction);
  /// Marks an output as wanted until it vanishes or unsubscribe().
  void subscribe(const std::string& name, bool wanted);
  bool subscribed(const std::string& name);
  /// Throws Error when the port has no room for a value that its reader has not seen.
  void count_write(const PortBase& port, std::uint64_t depth);

  /// What has been reported, oldest first.
  const std::vector<Message>& messages() const;

 private:
  /// Marks the world as in use while the interpreter's lock is not held.
  class Busy;

  /// Forgets ports that are no longer there.
  void prune();

  std::vector<Message> messages_;  // written while the world is made, so before it
  Resources resources_;
  PluginRegistry registry_;
  std::unique_ptr<World> world_;
  std::map<std::string, PortBase*> subscribed_;
  struct Writes {
    std::uint64_t step = 0, count = 0;
  };
  std::map<std::string, Writes> writes_;
  std::uint64_t restore_count_ = 0;
  std::atomic<bool> busy_{false};
};

}  // namespace trident::sim
