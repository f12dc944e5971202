// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/udp_endpoint.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "transport/socket_buffers.h"
#include "trident_base/error.h"

namespace trident::bridges {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr const char* kBroadcast = "255.255.255.255";

void set_flag(int socket, int option) {
  const int on = 1;
  setsockopt(socket, SOL_SOCKET, option, &on, sizeof(on));
}

}  // namespace

UdpEndpoint::UdpEndpoint(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
                         EndpointEvents events)
    : EndpointBase(options, loop, std::move(events)),
      peers_({options.max_peers, options.max_peer_rate, options.peer_timeout_s}),
      first_call_(loop),
      expiry_(loop) {
  open(url);
  loop_.watch(socket_.get(), PollLoop::kReadable, [this](std::uint32_t) { read(); });
  expire();
}

UdpEndpoint::~UdpEndpoint() { loop_.forget(socket_.get()); }

void UdpEndpoint::open(const EndpointUrl& url) {
  const SocketAddress address =
      resolve_allowed(options_.url, "bind", url.bind_host.empty() ? kLoopback : url.bind_host,
                      url.bind_port.value_or(options_.default_bind_port), options_.allow_remote);
  name_ = "udp " + address.text();
  socket_ = Descriptor(socket(address.family(), SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket_.is_open() || bind(socket_.get(), address.get(), address.size) != 0) {
    throw Error("url '" + options_.url + "': bind " + address.text() + ": " + std::strerror(errno));
  }
  const SocketAddress bound = local_address(socket_.get());
  port_ = bound.port();
  name_ = "udp " + bound.text();
  set_flag(socket_.get(), SO_RXQ_OVFL);
  const std::string buffers =
      set_socket_buffers(socket_.get(), options_.socket_buffer, options_.socket_buffer);
  add_given_peer(url);
  describe(buffers, bound);
}

void UdpEndpoint::add_given_peer(const EndpointUrl& url) {
  const bool is_broadcast = url.kind != EndpointKind::kUdp;
  if (url.host.empty() && !is_broadcast) return;
  const std::uint16_t port = url.port.value_or(options_.default_port);
  if (port == 0) throw Error("url '" + options_.url + "': host port is missing; legal: 1 to 65535");
  const SocketAddress address = resolve_allowed(
      options_.url, "host", url.host.empty() ? kBroadcast : url.host, port, options_.allow_remote);
  if (is_broadcast) set_flag(socket_.get(), SO_BROADCAST);
  broadcasts_until_answer_ = url.kind == EndpointKind::kUdpBroadcast;
  const PeerId id = peers_.add(address);
  // The owner gets this endpoint when the constructor has returned.
  first_call_.start(0.0, [this, id, text = address.text()] { report_joined(id, text); });
}

void UdpEndpoint::describe(const std::string& buffers, const SocketAddress& bound) {
  std::string text = buffers;
  for (const UdpPeers::Peer& peer : peers_.all()) text += "; sends to " + peer.address.text();
  if (!bound.is_loopback()) {
    text += "; other machines can reach it (allow_remote), up to " +
            std::to_string(options_.max_peers) + " peers";
  }
  report_notice(text);
}

// A batch at a time: other descriptors have their turn before the next.
void UdpEndpoint::read() {
  const std::size_t count = batch_.read(socket_.get());
  const double now_s = loop_.now_s();
  for (std::size_t i = 0; i < count; ++i) receive(i, now_s);
}

void UdpEndpoint::receive(std::size_t index, double now_s) {
  count_kernel_drops(index);
  UdpPeers::Peer* const peer = peer_of(batch_.source(index), now_s);
  if (peer == nullptr) return;
  peer->heard_s = now_s;
  if (!peer->bucket.take(now_s)) {
    ++counts_.limited;
    report_warning("rate", "peer " + peer->address.text() + " sends more than " +
                               std::to_string(static_cast<long>(options_.max_peer_rate)) +
                               " datagrams a second; the rest is counted only");
    return;
  }
  report_received(peer->id, batch_.bytes(index));
}

UdpPeers::Peer* UdpEndpoint::peer_of(const SocketAddress& source, double now_s) {
  if (UdpPeers::Peer* const known = peers_.find(source)) return known;
  UdpPeers::Peer* const learnt = peers_.learn(source, now_s);
  if (learnt == nullptr) {
    ++counts_.refused_peers;
    report_warning("peers", "peer " + source.text() + " is refused: there are " +
                                std::to_string(options_.max_peers) + " already");
    return nullptr;
  }
  const PeerId id = learnt->id;
  report_joined(id, source.text());
  return peers_.find(id);  // the owner may have dropped it
}

void UdpEndpoint::count_kernel_drops(std::size_t index) {
  const std::optional<std::uint32_t> drops = batch_.kernel_drops(index);
  if (!drops || *drops == newest_drops_) return;
  counts_.kernel_drops += static_cast<std::uint32_t>(*drops - newest_drops_);
  newest_drops_ = *drops;
  report_warning("drops", "the kernel dropped datagrams that did not fit the receive buffer");
}

bool UdpEndpoint::send(PeerId peer, Bytes block) { return send_batch(peer, {&block, 1}) == 1; }

int UdpEndpoint::send_batch(PeerId peer, Span<const Bytes> blocks) {
  UdpPeers::Peer* const known = peers_.find(peer);
  if (known == nullptr) return 0;
  int taken = 0;
  for (std::size_t begin = 0; begin < blocks.size(); begin += sent_parts_.size()) {
    const std::size_t count = std::min(blocks.size() - begin, sent_parts_.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Bytes block = blocks[begin + i];
      sent_parts_[i] = {const_cast<std::uint8_t*>(block.data()), block.size()};
      sent_headers_[i].msg_hdr.msg_name = known->address.get();
      sent_headers_[i].msg_hdr.msg_namelen = known->address.size;
    }
    taken += send_headers(count);
  }
  return taken;
}

// Of udp-b://, the broadcast address is used until there is another peer.
bool UdpEndpoint::is_addressed(const UdpPeers::Peer& peer) const {
  return !broadcasts_until_answer_ || peer.is_learnt || peers_.all().size() == 1;
}

int UdpEndpoint::send_to_all(Bytes block) {
  int taken = 0;
  std::size_t count = 0;
  for (const UdpPeers::Peer& peer : peers_.all()) {
    if (!is_addressed(peer)) continue;
    sent_parts_[count] = {const_cast<std::uint8_t*>(block.data()), block.size()};
    sent_headers_[count].msg_hdr.msg_name = const_cast<sockaddr*>(peer.address.get());
    sent_headers_[count].msg_hdr.msg_namelen = peer.address.size;
    if (++count == sent_parts_.size()) {
      taken += send_headers(count);
      count = 0;
    }
  }
  return taken + send_headers(count);
}

// A full send buffer cuts the rest. Other errors are those of one datagram: too long, or an earlier
// one found nobody at its address, which is no reason to keep this one.
int UdpEndpoint::send_headers(std::size_t count) {
  int taken = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sent_headers_[i].msg_hdr.msg_iov = &sent_parts_[i];
    sent_headers_[i].msg_hdr.msg_iovlen = 1;
  }
  for (std::size_t begin = 0; begin < count;) {
    const int sent = sendmmsg(socket_.get(), sent_headers_.data() + begin,
                              static_cast<unsigned>(count - begin), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent > 0) {
      for (int i = 0; i < sent; ++i) count_sent(sent_parts_[begin++].iov_len);
      taken += sent;
    } else if (errno == EAGAIN) {
      counts_.cut += count - begin;
      break;
    } else if (errno != EINTR) {
      ++counts_.cut;
      report_warning("send", std::string("a datagram of ") +
                                 std::to_string(sent_parts_[begin].iov_len) +
                                 " bytes was not sent: " + std::strerror(errno));
      ++begin;
    }
  }
  return taken;
}

std::vector<PeerInfo> UdpEndpoint::peers() const {
  std::vector<PeerInfo> result;
  for (const UdpPeers::Peer& peer : peers_.all()) result.push_back({peer.id, peer.address.text()});
  return result;
}

void UdpEndpoint::expire() {
  peers_.expire(loop_.now_s(),
                [this](PeerId id) { report_left(id, "silent for longer than its limit"); });
  expiry_.start(std::min(options_.peer_timeout_s / 4.0, 1.0), [this] { expire(); });
}

}  // namespace trident::bridges
