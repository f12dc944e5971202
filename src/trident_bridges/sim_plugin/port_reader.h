// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "trident_sim/world.h"

namespace trident::bridges {

/// Listens to an output of the world by its name, from when it is there on.
template <class Sample>
class PortReader {
 public:
  PortReader(sim::World& world, std::string name) : world_(world), name_(std::move(name)) {}
  ~PortReader() {
    if (auto* port = world_.ports().find_out<Sample>(name_)) {
      if (port == port_) port->remove_listener();
    }
  }
  PortReader(const PortReader&) = delete;
  PortReader& operator=(const PortReader&) = delete;

  /// The newest sample; nullptr: there is no such output, or it has published nothing yet.
  const Sample* newest() {
    look();
    return port_ != nullptr && port_->count() > 0 ? &port_->value : nullptr;
  }
  /// The newest sample, once; nullptr until the next one.
  const Sample* take() {
    const Sample* sample = newest();
    if (sample == nullptr || port_->count() == seen_) return nullptr;
    seen_ = port_->count();
    return sample;
  }
  /// There is such an output; it knows from now on that somebody listens.
  bool is_there() {
    look();
    return port_ != nullptr;
  }
  const std::string& name() const { return name_; }  ///< of the output
  void reset() { seen_ = 0; }                        ///< the next sample is new in any case
  /// Saves or restores what has been taken.
  void state(sim::StateArchive& archive) { archive(seen_); }

 private:
  void look() {
    if (world_.ports().version() == version_) return;
    version_ = world_.ports().version();
    auto* const found = world_.ports().find_out<Sample>(name_);
    if (found == port_) return;
    port_ = found;  // one that has gone took its listeners with it
    seen_ = 0;
    if (port_ != nullptr) port_->add_listener();
  }

  sim::World& world_;
  std::string name_;
  sim::OutPort<Sample>* port_ = nullptr;
  std::uint64_t version_ = ~std::uint64_t{0}, seen_ = 0;
};

}  // namespace trident::bridges
