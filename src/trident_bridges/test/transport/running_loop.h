// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/epoll_loop.h"

namespace trident::bridges {

/// Runs the loop until a condition holds; false when it does not within a minute.
template <class Condition>
bool run_until(EpollLoop& loop, Condition condition) {
  const double limit_s = loop.now_s() + 60.0;
  while (!condition()) {
    if (loop.now_s() > limit_s) return false;
    loop.run_once(0.01);
  }
  return true;
}

/// An endpoint and what it has reported.
struct Recorded {
  Recorded(EpollLoop& loop, EndpointOptions options) : options_(std::move(options)) {
    EndpointEvents events;
    events.received = [this](PeerId peer, Bytes block) {
      blocks.emplace_back(block.begin(), block.end());
      text[peer].append(block.begin(), block.end());
      newest = peer;
    };
    events.joined = [this](PeerId peer, const std::string& address) { joined[peer] = address; };
    events.left = [this](PeerId peer, const std::string& reason) { left[peer] = reason; };
    events.warning = [this](const std::string& sentence) { warnings.push_back(sentence); };
    events.notice = [this](const std::string& sentence) { notices.push_back(sentence); };
    endpoint = open_endpoint(options_, loop, std::move(events));
  }
  Recorded(EpollLoop& loop, const std::string& url) : Recorded(loop, options_of(url)) {}

  static EndpointOptions options_of(const std::string& url) {
    EndpointOptions options;
    options.url = url;
    return options;
  }
  bool has_joined() const { return !joined.empty(); }

  std::unique_ptr<Endpoint> endpoint;
  std::vector<std::string> blocks;
  std::map<PeerId, std::string> text, joined, left;
  std::vector<std::string> warnings, notices;
  PeerId newest = 0;

 private:
  EndpointOptions options_;
};

/// The bytes of a text.
inline Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The message of the Error that opening a URL ends with; empty: it can be opened.
inline std::string refusal_of(const EndpointOptions& options) {
  EpollLoop loop;
  try {
    open_endpoint(options, loop, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace trident::bridges
