// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/span.h"

namespace trident::bridges {

/// Number of a peer of an endpoint: an address of UDP, a connection of TCP; both are never used
/// again within a run. A serial line and a pseudo-terminal have peer 1 alone.
using PeerId = std::uint32_t;

/// A block of bytes that the caller owns.
using Bytes = Span<const std::uint8_t>;

/// What an endpoint has carried since it was opened.
struct EndpointCounts {
  std::uint64_t sent = 0;            ///< blocks handed to the kernel
  std::uint64_t sent_bytes = 0;      ///< bytes of them
  std::uint64_t received = 0;        ///< blocks: datagrams, or reads of a stream
  std::uint64_t received_bytes = 0;  ///< bytes of them
  std::uint64_t cut = 0;             ///< blocks that did not fit a slow peer's queue
  std::uint64_t limited = 0;         ///< datagrams beyond a peer's rate, which were not passed on
  std::uint64_t kernel_drops = 0;    ///< datagrams that the kernel dropped (SO_RXQ_OVFL)
  std::uint64_t refused_peers = 0;   ///< peers beyond the limit
  std::uint64_t reconnects = 0;      ///< how often a lost line or server was opened again

  /// Datagrams that came to this machine and were not passed on.
  std::uint64_t lost() const { return kernel_drops + limited; }
};

/// What an endpoint reports to its owner, always in the thread that runs the poll loop. The owner
/// must not destroy the endpoint within these calls. A function may be empty.
struct EndpointEvents {
  /// A datagram as it came, or what a stream had to read. The bytes live during the call.
  std::function<void(PeerId, Bytes)> received;
  /// A peer is there: a connection was made or accepted, a datagram came from a new address.
  std::function<void(PeerId, const std::string& address)> joined;
  /// It is gone: closed, unplugged, silent for longer than its limit. The text says why.
  std::function<void(PeerId, const std::string& reason)> left;
  /// A sentence for the log, with the endpoint, the value and the legal range; each kind of it is
  /// reported once.
  std::function<void(const std::string& text)> warning;
  /// A sentence for the log that is no warning: what was opened, with which buffers.
  std::function<void(const std::string& text)> notice;
};

/// A peer that is there.
struct PeerInfo {
  PeerId id = 0;        ///< for Endpoint::send()
  std::string address;  ///< "127.0.0.1:14550", or the device's name
};

/// One end of a connection: UDP, TCP (client or server), a serial line, a pseudo-terminal. Nothing
/// here blocks: what a peer does not take waits in a queue of limited size, and what does not fit
/// that is cut and counted. A lost serial line or TCP server is tried again by itself. All calls
/// are made from the thread that runs the poll loop, or before it runs.
class Endpoint {
 public:
  virtual ~Endpoint() = default;
  /// Sends one block to one peer. False when the peer is unknown or its queue is full.
  virtual bool send(PeerId peer, Bytes block) = 0;
  /// Sends several blocks to one peer, with one system call where that is possible; returns how
  /// many were taken.
  virtual int send_batch(PeerId peer, Span<const Bytes> blocks) = 0;
  /// Sends one block to all peers that are there; returns how many took it.
  virtual int send_to_all(Bytes block) = 0;
  /// Ends the connection to a peer, or forgets its address; EndpointEvents::left is not called.
  virtual void drop(PeerId peer) = 0;
  /// Those that are there now.
  virtual std::vector<PeerInfo> peers() const = 0;
  /// As it may be shown: "udp 127.0.0.1:14550", "pty /run/x/gps".
  virtual std::string name() const = 0;
  /// The port that is bound, of UDP and of a TCP server; 0 otherwise.
  virtual std::uint16_t port() const = 0;
  /// Since it was opened.
  virtual EndpointCounts counts() const = 0;
};

class PollLoop;

/// Of the characters on a serial line.
enum class Parity { kNone, kEven, kOdd };

/// How an endpoint is opened. Whatever is not given stands in the URL or has this default.
struct EndpointOptions {
  /// See transport/url.h.
  std::string url;
  bool allow_remote = false;            ///< may bind or connect to what is not loopback
  std::uint16_t default_bind_port = 0;  ///< where the URL has none; 0: a free one
  std::uint16_t default_port = 0;  ///< the peer's, where the URL has none; 0: the URL must have it
  std::uint32_t default_baud = 57600;  ///< where the URL has none [bit/s]
  Parity parity = Parity::kNone;       ///< of a serial line
  int stop_bits = 1;                   ///< of a serial line: 1 or 2
  /// Serial, pty: a block leaves when its last byte would on a line of baud/10 bytes a second.
  bool keeps_baud = true;
  std::uint32_t max_peers = 16;            ///< more are refused and counted
  double max_peer_rate = 20000.0;          ///< datagrams of a peer [1/s]; more are counted only
  double peer_timeout_s = 60.0;            ///< a silent UDP peer that was learnt is forgotten
  double retry_s = 0.2;                    ///< between attempts to open a lost line or server again
  std::uint32_t queue_bytes = 256 * 1024;  ///< what waits for a slow peer
  std::uint32_t socket_buffer = 4 * 1024 * 1024;  ///< asked of the kernel; it may give less
};

/// Opens an endpoint that reports to `events` in `loop`'s thread. `loop` must outlive it. Throws
/// Error with the URL, the field, the value and the legal range. A serial device or a TCP server
/// that is not there yet is no error: it is tried again until it is.
std::unique_ptr<Endpoint> open_endpoint(const EndpointOptions& options, PollLoop& loop,
                                        EndpointEvents events);

}  // namespace trident::bridges
