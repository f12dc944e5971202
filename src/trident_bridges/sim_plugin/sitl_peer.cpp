// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sitl_peer.h"

#include "trident_base/error.h"

namespace trident::bridges {
namespace {

constexpr double kPatience_s = 30.0;  ///< without a server, wall time

}  // namespace

SitlPeer::SitlPeer(const sim::PluginContext& context, const std::string& program)
    : all_(context.world.extensions().get<sim::OutsideAutopilots>(context.world)),
      loop_(context.world.extensions().get<SitlLoop>(context.world).loop),
      world_(context.world),
      owner_(context.params.owner()),
      program_(program) {
  if (context.model == nullptr) throw Error(owner_ + ": belongs in a model");
  all_.add(*this);
}

SitlPeer::~SitlPeer() { all_.remove(*this); }

void SitlPeer::open(const sim::PluginParams& params, const std::string& element,
                    const std::string& url) {
  EndpointOptions options;
  options.url = url;
  // A program that is started again sends datagrams from another port.
  options.max_peers = url.compare(0, 3, "udp") == 0 ? 1000 : 1;
  options.peer_timeout_s = 1e9;
  options.max_peer_rate = 1e6;
  options.allow_remote = params.flag("allow_remote", false);
  EndpointEvents events;
  events.received = [this](PeerId peer, Bytes bytes) {
    peer_ = peer;
    received(bytes);
  };
  events.joined = [this](PeerId peer, const std::string& /*address*/) {
    peer_ = peer;
    joined();
  };
  events.left = [this](PeerId peer, const std::string& /*reason*/) {
    if (peer != peer_) return;
    peer_ = 0;
    left();
  };
  events.warning = [this](const std::string& text) {
    world_.report(sim::Severity::kWarning, owner_ + ": " + text);
  };
  try {
    endpoint_ = open_endpoint(options, loop_, std::move(events));
  } catch (const Error& error) {
    params.refuse(element, params.text(element, ""),
                  std::string("a port that is free: ") + error.what());
  }
  const std::size_t at = owner_.find(" plugin ");
  who_ = owner_.substr(0, at) + ": " + program_ + " at " + endpoint_->name();
}

void SitlPeer::receive(double timeout_s) { loop_.run_once(timeout_s); }

void SitlPeer::send(Span<const std::uint8_t> block) {
  if (peer_ == 0) return;
  if (!endpoint_->send(peer_, block)) {
    world_.diagnose({sim::Severity::kError,
                     owner_,
                     "packet not sent",
                     "a packet to " + who_ + " was not sent: its queue is full",
                     {}});
  }
}

void SitlPeer::wait_in_step() {
  if (!is_awaited()) return receive(0.0);  // one that nobody waits for may have come
  const double begin_s = wall_s();
  while (is_awaited()) {
    receive(0.001);
    if (wall_s() - begin_s > kPatience_s) throw Error(who_ + " " + awaited() + " for 30 s");
  }
}

std::string read_address(const sim::PluginParams& params, const std::string& element) {
  const std::string address = params.text(element, "127.0.0.1");
  if (address == "INADDR_ANY" || address == "0.0.0.0" || address.empty()) return "127.0.0.1";
  return address;
}

}  // namespace trident::bridges
