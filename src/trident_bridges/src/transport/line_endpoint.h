// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "transport/descriptor.h"
#include "transport/endpoint_base.h"
#include "transport/line_sender.h"
#include "trident_bridges/transport/url.h"

namespace trident::bridges {

/// An endpoint with one peer, which may be there or not.
class LineEndpoint : public EndpointBase {
 public:
  ~LineEndpoint() override;

  static constexpr PeerId kPeer = 1;  ///< the only one

  bool send(PeerId peer, Bytes block) override { return peer == kPeer && sender_.take(block); }
  int send_batch(PeerId peer, Span<const Bytes> blocks) override;
  int send_to_all(Bytes block) override { return sender_.take(block) ? 1 : 0; }
  void drop(PeerId) override {}
  std::vector<PeerInfo> peers() const override;
  std::uint16_t port() const override { return 0; }

 protected:
  /// `baud`: of the URL or its default; it counts where options.keeps_baud.
  LineEndpoint(const EndpointOptions& options, std::uint32_t baud, PollLoop& loop,
               EndpointEvents events);

  /// The peer is there: reads from and writes to this descriptor, which stays the derived class's.
  void attach(int descriptor, const std::string& address);
  bool is_attached() const { return descriptor_ >= 0; }  ///< the peer is there
  /// Forgets the descriptor without a report.
  void detach();
  /// The peer is gone, which has been reported; detach() was called.
  virtual void line_ended() = 0;

 private:
  void read();

  LineSender sender_;
  int descriptor_ = -1;
  std::string address_;
  std::vector<std::uint8_t> buffer_;  ///< of what is read
};

/// A serial device, which is opened again when it was unplugged. A pseudo-terminal that has
/// vanished is held open until then: as long as it is, no program gets another one of its number,
/// to which its name or a link that was left behind would lead.
class SerialEndpoint : public LineEndpoint {
 public:
  /// Throws Error as open_endpoint() does.
  SerialEndpoint(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
                 EndpointEvents events);
  ~SerialEndpoint() override { detach(); }

 protected:
  void line_ended() override;

 private:
  void open();
  std::string open_device();

  EndpointUrl url_;
  std::uint32_t baud_;
  Descriptor device_;
  Descriptor vanished_;  ///< pseudo-terminal
  bool was_open_ = false;
  DelayedCall attempt_;
};

/// A pseudo-terminal with a symbolic link to its far end. The peer is there while a program has
/// that open; what is sent before is dropped, as on a line that nobody reads.
class PtyEndpoint : public LineEndpoint {
 public:
  /// Throws Error as open_endpoint() does.
  PtyEndpoint(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
              EndpointEvents events);
  ~PtyEndpoint() override;

 protected:
  void line_ended() override;

 private:
  void open();
  void make_link();
  void look_for_peer();

  std::string link_;
  std::string far_end_;  ///< /dev/pts/N
  Descriptor terminal_;
  DelayedCall look_;
};

}  // namespace trident::bridges
