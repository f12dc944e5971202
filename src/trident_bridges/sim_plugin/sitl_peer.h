// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/epoll_loop.h"
#include "trident_sim/outside_autopilots.h"
#include "trident_sim/world.h"

namespace trident::bridges {

/// The poll loop that all outside autopilots of a world share.
class SitlLoop : public sim::StepExtension {
 public:
  explicit SitlLoop(sim::World& /*world*/) {}
  void begin_steps() override {}
  void end_phase(sim::Phase) override {}
  EpollLoop loop;  ///< run by the stepping thread alone
};

/// What both plugins have in common: their place among the world's outside autopilots, one
/// endpoint with one peer, and the wait for it in a world without a server.
class SitlPeer : public sim::OutsideAutopilot {
 public:
  /// `program`: "PX4" or "ArduPilot".
  SitlPeer(const sim::PluginContext& context, const std::string& program);
  ~SitlPeer() override;
  SitlPeer(const SitlPeer&) = delete;
  SitlPeer& operator=(const SitlPeer&) = delete;

  std::string who() const override { return who_; }
  void receive(double timeout_s) override;

 protected:
  /// Opens `url` for one connection, or for datagrams from anyone, of whom the newest counts.
  /// Throws Error that names `element`, its value and the legal range.
  void open(const sim::PluginParams& params, const std::string& element, const std::string& url);
  /// Sends a block to the peer that is there; none: nothing happens.
  void send(Span<const std::uint8_t> block);
  /// As a step begins: takes what has come. Without a server it waits for what is_awaited() says,
  /// and throws Error when that has not come for 30 s of wall time.
  void wait_in_step();
  double wall_s() const { return loop_.now_s(); }  ///< never jumps

  virtual void joined() {}                                    ///< a peer is there
  virtual void left() {}                                      ///< it has gone
  virtual void received(Span<const std::uint8_t> bytes) = 0;  ///< what it sent

 private:
  sim::OutsideAutopilots& all_;
  EpollLoop& loop_;
  sim::World& world_;
  std::string owner_, program_, who_;
  std::unique_ptr<Endpoint> endpoint_;
  PeerId peer_ = 0;  ///< 0: nobody
};

/// The address in a URL: where an autopilot's program runs on this machine. "INADDR_ANY" and the
/// like mean loopback here, too. Throws Error for another one unless `<allow_remote>` is true.
std::string read_address(const sim::PluginParams& params, const std::string& element);

}  // namespace trident::bridges
