// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/modbus_link.h"

#include <algorithm>
#include <utility>

namespace trident::bridges::modbus {
namespace {

constexpr PeerId kLinePeer = 1;  // of a serial line
// A client that keeps asking and takes no answers; a whole response of each pipelined request fits.
constexpr std::uint32_t kQueueBytes = 64 * 1024;

Parity parity_of(LineParity parity) {
  switch (parity) {
    case LineParity::kEven:
      return Parity::kEven;
    case LineParity::kOdd:
      return Parity::kOdd;
    case LineParity::kNone:
      break;
  }
  return Parity::kNone;
}

/// A device whose name begins with pty: is a pseudo-terminal that the link makes.
std::string url_of(const TransportSpec& spec, Role role) {
  if (spec.kind == TransportKind::kTcp) {
    const std::string where = spec.host + ":" + std::to_string(spec.port);
    return (role == Role::kServer ? "tcp-l://" : "tcp://") + where;
  }
  const std::string scheme = spec.device.rfind("pty:", 0) == 0 ? "" : "serial://";
  return scheme + spec.device + ":" + std::to_string(spec.baud);
}

EndpointOptions options_of(const TransportSpec& spec, Role role, const LinkOptions& options) {
  EndpointOptions result;
  result.url = url_of(spec, role);
  result.allow_remote = options.allow_remote;
  result.max_peers = options.max_peers;
  result.parity = parity_of(spec.parity);
  result.stop_bits = spec.stop_bits;
  result.queue_bytes = kQueueBytes;
  return result;
}

}  // namespace

ModbusLink::ModbusLink(const TransportSpec& spec, Role role, const LinkOptions& options,
                       PollLoop& loop, LinkEvents events)
    : role_(role), loop_(loop), events_(std::move(events)) {
  if (spec.kind == TransportKind::kRtu) {
    timing_ = rtu_timing(spec.baud);
    line_.emplace(timing_.silence_s + spec.jitter, spec.echo);
  }
  endpoint_ = open_endpoint(options_of(spec, role, options), loop, endpoint_events());
}

ModbusLink::~ModbusLink() {
  for (const auto& call : {silence_call_, send_call_}) {
    if (call) loop_.cancel(*call);
  }
}

EndpointEvents ModbusLink::endpoint_events() {
  EndpointEvents events;
  events.received = [this](PeerId peer, Bytes bytes) {
    if (line_) {
      receive_line(bytes);
    } else {
      receive_stream(peer, bytes);
    }
  };
  events.joined = [this](PeerId peer, const std::string& address) {
    peers_[peer].address = address;
    if (events_.joined) events_.joined(peer);
  };
  events.left = [this](PeerId peer, const std::string& reason) {
    if (events_.notice) events_.notice(peer_text(peer) + " has left: " + reason);
    if (events_.left) events_.left(peer);
    peers_.erase(peer);
    outgoing_.erase(peer);
  };
  events.warning = events_.warning;
  events.notice = events_.notice;
  return events;
}

std::string ModbusLink::peer_text(PeerId peer) const {
  const auto found = peers_.find(peer);
  return name() + (found == peers_.end() ? "" : ": " + found->second.address);
}

void ModbusLink::receive_stream(PeerId id, Bytes bytes) {
  const auto peer = peers_.find(id);
  if (peer == peers_.end()) return;
  TcpFrameReader& reader = peer->second.reader;
  reader.feed(bytes);
  is_receiving_ = true;
  while (const auto frame = reader.next()) {
    report_frame({id, frame->unit, frame->transaction, frame->pdu});
  }
  is_receiving_ = false;
  flush();
  if (!reader.problem().empty()) drop(id, reader.problem());
}

void ModbusLink::report_frame(const LinkFrame& frame) {
  if (events_.frame) events_.frame(frame);
}

void ModbusLink::drop(PeerId peer, const std::string& problem) {
  if (events_.refused) {
    events_.refused("no Modbus TCP",
                    peer_text(peer) + ": " + problem + "; the connection is ended");
  }
  if (events_.left) events_.left(peer);
  peers_.erase(peer);
  outgoing_.erase(peer);
  endpoint_->drop(peer);
}

/// What came before is judged first: the silence after it may have gone unnoticed.
void ModbusLink::receive_line(Bytes bytes) {
  read_line();
  line_->feed(bytes, loop_.now_s());
  read_line();
}

void ModbusLink::read_line() {
  is_receiving_ = true;
  while (const auto frame = line_->next(loop_.now_s())) {
    // The requests of other masters and the responses of other devices are on the line, too.
    const bool is_ours = role_ == Role::kServer ? frame->may_be_request : frame->may_be_response;
    if (is_ours) report_frame({kLinePeer, frame->unit, std::nullopt, frame->pdu});
  }
  is_receiving_ = false;
  note_line();
  flush();
  if (const auto deadline_s = line_->deadline_s()) {
    call_later(silence_call_, *deadline_s, [this] { read_line(); });
  }
}

void ModbusLink::note_line() {
  const RtuCounts& counts = line_->counts();
  if (counts.bad_frames > noted_.bad_frames && events_.refused) {
    events_.refused("noise", name() + ": " +
                                 std::to_string(counts.noise_bytes - noted_.noise_bytes) +
                                 " bytes between two silences, legal: a frame with a valid CRC");
  }
  noted_ = counts;
}

void ModbusLink::send(PeerId peer, std::uint8_t unit, std::optional<std::uint16_t> transaction,
                      Bytes pdu) {
  std::vector<std::uint8_t>& out = outgoing_[peer];
  if (line_) {
    append_rtu_frame(unit, pdu, out);
  } else {
    append_tcp_frame({transaction.value_or(0), unit, pdu}, out);
  }
}

void ModbusLink::flush() {
  if (is_receiving_) return;
  if (line_) return send_line();
  for (auto& [peer, bytes] : outgoing_) {
    if (bytes.empty()) continue;
    endpoint_->send(peer, bytes);
    bytes.clear();
  }
}

void ModbusLink::send_line() {
  const auto out = outgoing_.find(kLinePeer);
  if (out == outgoing_.end() || out->second.empty()) return;
  const double free_s = line_->last_byte_s() + timing_.silence_s;
  if (loop_.now_s() < free_s) return call_later(send_call_, free_s, [this] { send_line(); });
  line_->expect_echo(out->second);
  endpoint_->send(kLinePeer, out->second);
  out->second.clear();
}

void ModbusLink::call_later(std::optional<std::uint64_t>& call, double at_s,
                            std::function<void()> callback) {
  if (call) loop_.cancel(*call);
  call = loop_.call_after(std::max(0.0, at_s - loop_.now_s()),
                          [&call, callback = std::move(callback)] {
                            call.reset();
                            callback();
                          });
}

}  // namespace trident::bridges::modbus
