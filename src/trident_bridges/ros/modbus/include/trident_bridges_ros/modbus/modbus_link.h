// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges/modbus/map_spec.h"
#include "trident_bridges/modbus/mbap.h"
#include "trident_bridges/modbus/rtu.h"
#include "trident_bridges/modbus/topic_bindings.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/poll_loop.h"

namespace trident::bridges::modbus {

/// A frame that has come.
struct LinkFrame {
  PeerId peer = 0;
  std::uint8_t unit = 0;                     ///< of the device
  std::optional<std::uint16_t> transaction;  ///< over TCP
  Bytes pdu;                                 ///< valid during the call
};

/// What a link reports to its owner, in the thread of the poll loop.
struct LinkEvents {
  std::function<void(const LinkFrame& frame)> frame;
  std::function<void(PeerId peer)> joined;
  std::function<void(PeerId peer)> left;
  /// Something that came was no frame: its kind, of a small set, and a sentence with link, peer,
  /// field, value and legal range.
  std::function<void(const std::string& kind, const std::string& text)> refused;
  /// Sentences for the log.
  std::function<void(const std::string&text)> warning, notice;
};

/// How a link is opened, besides what a map says.
struct LinkOptions {
  bool allow_remote = false;     ///< may bind or connect to what is not loopback
  std::uint32_t max_peers = 64;  ///< clients of a TCP server; more are refused and counted
};

/// Frames of Modbus over TCP or a serial line. What is sent within a call of LinkEvents::frame goes
/// out with one system call behind it. On a serial line a frame waits until the line has been
/// silent for 3.5 characters.
class ModbusLink {
 public:
  /// Opens the endpoint of `spec`; a server listens where a client connects to. Throws Error with
  /// the URL. `loop` outlives the link.
  ModbusLink(const TransportSpec& spec, Role role, const LinkOptions& options, PollLoop& loop,
             LinkEvents events);
  ~ModbusLink();
  ModbusLink(const ModbusLink&) = delete;
  ModbusLink& operator=(const ModbusLink&) = delete;

  /// Sends a frame to a peer that has joined, or with the next flush().
  void send(PeerId peer, std::uint8_t unit, std::optional<std::uint16_t> transaction, Bytes pdu);
  /// Sends what send() has collected outside of LinkEvents::frame.
  void flush();
  bool is_serial() const { return line_.has_value(); }      ///< one request at a time
  std::string name() const { return endpoint_->name(); }    ///< as it may be shown
  std::uint16_t port() const { return endpoint_->port(); }  ///< of a TCP server
  std::string peer_text(PeerId peer) const;  ///< "tcp 127.0.0.1:1502: 127.0.0.1:40000"
  EndpointCounts counts() const { return endpoint_->counts(); }  ///< of the endpoint
  RtuCounts line_counts() const { return line_ ? line_->counts() : RtuCounts(); }  ///< of a line

 private:
  /// A connection of TCP.
  struct Peer {
    std::string address;
    TcpFrameReader reader;
  };

  EndpointEvents endpoint_events();
  void receive_stream(PeerId peer, Bytes bytes);
  void receive_line(Bytes bytes);
  void read_line();
  void report_frame(const LinkFrame& frame);
  void note_line();
  void drop(PeerId peer, const std::string& problem);
  void send_line();
  void call_later(std::optional<std::uint64_t>& call, double at_s, std::function<void()> callback);

  Role role_;
  PollLoop& loop_;
  LinkEvents events_;
  std::map<PeerId, Peer> peers_;
  std::optional<RtuFrameReader> line_;
  RtuTiming timing_;
  RtuCounts noted_;  ///< of the line, as reported
  std::map<PeerId, std::vector<std::uint8_t>> outgoing_;
  bool is_receiving_ = false;
  std::optional<std::uint64_t> silence_call_, send_call_;
  std::unique_ptr<Endpoint> endpoint_;
};

}  // namespace trident::bridges::modbus
