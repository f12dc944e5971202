// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/line_endpoint.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace trident::bridges {
namespace {

constexpr std::size_t kReadSize = 16 * 1024;

// Of a byte with its start, parity and stop bits.
double byte_duration_s(const EndpointOptions& options, std::uint32_t baud) {
  if (!options.keeps_baud) return 0.0;
  const int bits = 9 + options.stop_bits + (options.parity == Parity::kNone ? 0 : 1);
  return static_cast<double>(bits) / static_cast<double>(baud);
}

}  // namespace

LineEndpoint::LineEndpoint(const EndpointOptions& options, std::uint32_t baud, PollLoop& loop,
                           EndpointEvents events)
    : EndpointBase(options, loop, std::move(events)),
      sender_(loop, counts_, byte_duration_s(options, baud), options.queue_bytes),
      buffer_(kReadSize) {}

LineEndpoint::~LineEndpoint() = default;

void LineEndpoint::attach(int descriptor, const std::string& address) {
  descriptor_ = descriptor;
  address_ = address;
  sender_.attach(descriptor);
  loop_.watch(descriptor, PollLoop::kReadable, [this](std::uint32_t what) {
    if ((what & PollLoop::kWritable) != 0) sender_.write();
    if ((what & (PollLoop::kReadable | PollLoop::kClosed)) != 0) read();
  });
  report_joined(kPeer, address_);
}

void LineEndpoint::detach() {
  if (!is_attached()) return;
  loop_.forget(descriptor_);
  sender_.detach();
  descriptor_ = -1;
}

void LineEndpoint::read() {
  const auto size = ::read(descriptor_, buffer_.data(), buffer_.size());
  if (size > 0) {
    report_received(kPeer, {buffer_.data(), static_cast<std::size_t>(size)});
    return;
  }
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
  const std::string reason = size == 0 ? "closed" : std::strerror(errno);
  detach();
  report_left(kPeer, reason);
  line_ended();
}

int LineEndpoint::send_batch(PeerId peer, Span<const Bytes> blocks) {
  int taken = 0;
  for (const Bytes block : blocks) taken += send(peer, block) ? 1 : 0;
  return taken;
}

std::vector<PeerInfo> LineEndpoint::peers() const {
  if (!is_attached()) return {};
  return {{kPeer, address_}};
}

}  // namespace trident::bridges
