// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/packet_writer.h"
#include "trident_bridges/mavlink/router.h"
#include "trident_bridges/mavlink/signing.h"
#include "trident_bridges/mavlink/signing_file.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/poll_loop.h"

namespace trident::mavros {

using bridges::mavlink::Address;
using bridges::mavlink::Message;
using bridges::mavlink::Packet;

/// Where an end listens whose URL has no port of this computer.
inline constexpr std::uint16_t kDefaultBindPort = 14555;

/// Which ends a link has.
struct LinkOptions {
  std::string fcu_url;              ///< of the vehicle, see transport/url.h
  std::string gcs_url;              ///< of the ground station; empty: has none
  bool allow_remote = false;        ///< may bind or connect to what is not loopback
  double max_peer_rate = 20'000.0;  ///< packets of a peer, and of this node [1/s]; more are dropped
  /// 64 hexadecimal digits: what is sent is signed, and what this node hears must be; empty: none.
  std::string signing_key_file;
};

/// What this node signs with, and what it believes; nothing where it has no key.
class LinkKey {
 public:
  /// `file`: of the key; its times are kept next to it. Throws Error for a key that cannot be used.
  explicit LinkKey(const std::string& file);
  /// nullptr: nothing is signed.
  bridges::mavlink::PacketSigner* signer() { return signer_.get(); }
  /// Why a packet may not be used; empty: it may.
  std::string refusal(const Packet& packet);

 private:
  std::unique_ptr<bridges::mavlink::SigningFile> store_;
  std::unique_ptr<bridges::mavlink::Signing> signing_;
  std::unique_ptr<bridges::mavlink::PacketSigner> signer_;
};

/// What comes from the vehicle's end and from that of the ground station, forwarded between both by
/// the rules of MAVLink, and this node as a third end. In the loop's thread.
class Link {
 public:
  /// What a link reports.
  struct Events {
    std::function<void(const Packet&)> received;           ///< what this node is to hear
    std::function<void(const std::string& text)> warning;  ///< a sentence for the log
    std::function<void(const std::string& text)> notice;   ///< what was opened, with which buffers
    /// A packet is dropped because of its signature; the text says why.
    std::function<void(const std::string& text)> refused;
  };

  /// Opens both ends. `loop` must outlive it. Throws Error with the URL and what is wrong with it.
  Link(const LinkOptions& options, bridges::PollLoop& loop, Events events);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Sends a message of this node to all whom it concerns. Throws Error for a message that the
  /// dialect does not have.
  void send(const Message& message);
  /// Sends a whole packet of another program as it is.
  void send_packet(bridges::Bytes packet);

 private:
  struct End {
    std::unique_ptr<bridges::Endpoint> endpoint;
  };
  void open(const std::string& url, const LinkOptions& options, bridges::PollLoop& loop);
  void forget_silent_ids(bridges::PollLoop& loop);
  /// Reports what came for this node, once the router is done with it: hearing makes it send.
  void hear();
  void pass_on(bridges::mavlink::RouterPeer peer, bridges::Bytes packet);

  bridges::PollLoop& loop_;
  Events events_;
  LinkKey key_;
  bridges::mavlink::Router router_;
  bridges::mavlink::PacketParser parser_;
  bridges::mavlink::PacketWriter writer_;
  std::vector<std::unique_ptr<End>> ends_;
  std::vector<std::uint8_t> inbox_;  // whole packets for this node
  std::vector<std::uint8_t> heard_;  // the same, of which it hears now
  std::uint64_t next_look_ = 0;
};

}  // namespace trident::mavros
