// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "trident_base/span.h"

namespace trident::bridges {

/// Number of somebody at the other end of an endpoint: an address of UDP, a connection of TCP; a
/// serial line has peer 1 alone. Never given twice within a run.
using PeerId = std::uint32_t;

/// A block of bytes that somebody else owns.
using Bytes = Span<const std::uint8_t>;

/// What an endpoint has carried since it was opened.
struct EndpointCounts {
  std::uint64_t sent = 0;            ///< blocks handed to the kernel
  std::uint64_t sent_bytes = 0;      ///< bytes of them
  std::uint64_t received = 0;        ///< blocks: datagrams, or reads of a stream
  std::uint64_t received_bytes = 0;  ///< bytes of them
  std::uint64_t cut = 0;             ///< blocks that did not fit a slow peer's queue
  std::uint64_t kernel_drops = 0;    ///< datagrams that the kernel dropped (SO_RXQ_OVFL)
  std::uint64_t refused_peers = 0;   ///< peers beyond the limit
};

/// What an endpoint tells its owner, always from the thread that runs the poll loop.
struct EndpointEvents {
  /// A datagram as it came, or what a stream had to read. The bytes live during the call.
  std::function<void(PeerId, Bytes)> received;
  /// A peer is there: a connection was made or accepted, a datagram came from a new address.
  std::function<void(PeerId, const std::string& address)> joined;
  /// It is gone: closed, unplugged, silent for longer than its limit. The text says why.
  std::function<void(PeerId, const std::string& reason)> left;
  /// Trouble that is worth one message: the endpoint, the value and the legal range.
  std::function<void(const std::string& text)> trouble;
};

/// One end of a connection: UDP, TCP (client or server), a serial line, a pseudo-terminal. Nothing
/// here blocks: what a peer does not take waits in a queue of limited size, and what does not fit
/// that is cut and counted. A lost serial line or TCP server is tried again by itself.
class Endpoint {
 public:
  virtual ~Endpoint() = default;
  /// Sends one block to one peer. False when the peer is unknown or its queue is full.
  virtual bool send(PeerId peer, Bytes block) = 0;
  /// Sends one block to all peers that are there; returns how many took it.
  virtual int send_to_all(Bytes block) = 0;
  /// As it may be shown: "udp 127.0.0.1:14550", "pty /run/x/gps".
  virtual std::string name() const = 0;
  /// Since it was opened.
  virtual EndpointCounts counts() const = 0;
};

class PollLoop;

/// How an endpoint is opened. Whatever is not given stands in the URL or has this default.
struct EndpointOptions {
  /// udp://[bind][:port]@[host][:port], tcp://host:port, tcp-l://[bind][:port],
  /// serial://device[:baud], pty://link[:baud] (a link to the pseudo-terminal's far end).
  std::string url;
  bool allow_remote = false;               ///< may bind or connect to what is not loopback
  std::uint32_t max_peers = 16;            ///< more are refused and counted
  double peer_timeout_s = 60.0;            ///< a silent UDP peer that was learnt is forgotten
  std::uint32_t queue_bytes = 256 * 1024;  ///< what waits for a slow peer
  std::uint32_t socket_buffer = 4 * 1024 * 1024;  ///< asked of the kernel; it may give less
};

/// Opens an endpoint that tells `events` from `loop`'s thread. `loop` must outlive it. Throws Error
/// with the URL, the field, the value and the legal range.
std::unique_ptr<Endpoint> open_endpoint(const EndpointOptions& options, PollLoop& loop,
                                        EndpointEvents events);

}  // namespace trident::bridges
