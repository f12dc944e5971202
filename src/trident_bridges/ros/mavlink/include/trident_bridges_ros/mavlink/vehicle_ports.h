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
#include "trident_bridges/mavlink/signing.h"
#include "trident_bridges/mavlink/signing_file.h"
#include "trident_bridges/mavlink/vehicles.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/poll_loop.h"

namespace trident::bridges {

/// What one vehicle signs with, and what it believes; nothing where it has no key.
class VehicleKey {
 public:
  /// `file`: of the key; empty: none. Throws Error for a key that cannot be used.
  explicit VehicleKey(const std::string& file);
  /// For the packets of one link; nullptr: nothing is signed.
  mavlink::PacketSigner* signer(std::uint8_t link);
  /// Whether a packet may be used; empty: it may, else why not.
  std::string refusal(const mavlink::Packet& packet);

 private:
  std::unique_ptr<mavlink::SigningFile> store_;
  std::unique_ptr<mavlink::Signing> signing_;
  std::vector<std::unique_ptr<mavlink::PacketSigner>> signers_;
};

/// The ports of one vehicle alone: for offboard programs and for ground stations by
/// UDP, and a TCP server.
class VehiclePorts {
 public:
  /// What they are opened with, and who hears what comes.
  struct Setup {
    bool allow_remote = false;      ///< may be reached from other computers
    std::uint16_t gcs_remote_port;  ///< where ground stations listen
    /// A message has come; the text names the port and the sender's address.
    std::function<void(const mavlink::Message&, const std::string& from)> received;
    /// A packet was refused: its kind and a whole sentence.
    std::function<void(const std::string& kind, const std::string& text)> refused;
  };
  /// Opens all. `key` and `loop` must outlive it. Throws Error naming the vehicle, the port and
  /// what is wrong with it.
  VehiclePorts(const mavlink::VehicleLinks& links, Setup setup, VehicleKey& key, PollLoop& loop);
  ~VehiclePorts();
  /// For all who are there; leaves with flush(), or when a datagram is full.
  void send(const mavlink::Message& message);
  /// Sends what waits: several packets are one datagram, which costs less than several.
  void flush();

 private:
  struct Port;
  static void flush(Port& port);
  void open(const std::string& url, bool has_datagrams, PollLoop& loop);
  void receive(Port& port, PeerId peer, Bytes bytes);

  std::string vehicle_;
  bool accept_mavlink1_;
  Setup setup_;
  VehicleKey& key_;
  std::vector<std::unique_ptr<Port>> ports_;
  bool has_waiting_ = false;
};

}  // namespace trident::bridges
