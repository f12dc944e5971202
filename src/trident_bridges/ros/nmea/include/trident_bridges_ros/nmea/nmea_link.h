// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/poll_loop.h"
#include "trident_bridges_ros/nmea/sentence_reader.h"
#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::bridges {

/// A connection: its peers' bytes are framed and read one by one, and sentences go to all of them.
/// Over TCP and by radio, sentences that follow one another closely are sent together, the first
/// one at once.
class NmeaLink {
 public:
  /// Opens the endpoint; `loop`, `node` and what `hooks` point to outlive the link. `listens`: what
  /// comes is read. Throws Error with the URL.
  NmeaLink(const EndpointOptions& options, const NmeaReadParams& params, NmeaReadHooks hooks,
           bool listens, NodePollLoop& loop, ros::NodeHandle& node);
  NmeaLink(const NmeaLink&) = delete;
  NmeaLink& operator=(const NmeaLink&) = delete;

  /// To all peers that are there.
  void send(std::string_view sentence);
  std::string name() const { return endpoint_->name(); }         ///< of the endpoint
  EndpointCounts counts() const { return endpoint_->counts(); }  ///< of the endpoint
  nmea::FramerCounts framed() const;                             ///< of all peers, gone ones too

 private:
  void join(PeerId id, const std::string& address);
  void leave(PeerId id, const std::string& reason);
  void receive(PeerId id, Bytes bytes);
  void send_now(std::string_view text);
  void flush();

  NmeaReadParams params_;
  NmeaReadHooks hooks_;
  PollLoop& loop_;
  bool listens_, is_datagrams_, is_gathering_;
  std::string waiting_;  ///< sentences that flush() sends
  double sent_s_ = 0.0;  ///< when the last one was handed over
  std::map<PeerId, std::unique_ptr<SentenceReader>> peers_;
  nmea::FramerCounts gone_;  ///< of peers that are gone
  std::unique_ptr<Endpoint> endpoint_;
};

}  // namespace trident::bridges
