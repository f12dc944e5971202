// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>

#include "transport/line_endpoint.h"
#include "transport/tcp_endpoint.h"
#include "transport/udp_endpoint.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

void check(bool is_legal, const std::string& field, double value, const std::string& legal) {
  if (is_legal) return;
  throw Error(field + " " + number_text(value) + " is not legal; legal: " + legal);
}

void check_options(const EndpointOptions& options) {
  check(options.max_peers >= 1 && options.max_peers <= 4096, "max_peers", options.max_peers,
        "1 to 4096");
  check(options.max_peer_rate >= 1.0 && std::isfinite(options.max_peer_rate), "max_peer_rate",
        options.max_peer_rate, "1 or more, finite");
  check(options.peer_timeout_s > 0.0, "peer_timeout_s", options.peer_timeout_s, "above 0");
  check(options.retry_s >= 0.01 && options.retry_s <= 60.0, "retry_s", options.retry_s,
        "0.01 to 60");
  check(options.queue_bytes >= 1024 && options.queue_bytes <= 1U << 30, "queue_bytes",
        options.queue_bytes, "1024 to 1073741824");
  check(options.socket_buffer >= 4096 && options.socket_buffer <= 1U << 30, "socket_buffer",
        options.socket_buffer, "4096 to 1073741824");
  check(options.stop_bits == 1 || options.stop_bits == 2, "stop_bits", options.stop_bits, "1, 2");
  check(options.default_baud >= 50 && options.default_baud <= 4'000'000, "baud",
        options.default_baud, "50 to 4000000");
}

}  // namespace

std::unique_ptr<Endpoint> open_endpoint(const EndpointOptions& options, PollLoop& loop,
                                        EndpointEvents events) {
  check_options(options);
  const EndpointUrl url = parse_endpoint_url(options.url);
  switch (url.kind) {
    case EndpointKind::kUdp:
    case EndpointKind::kUdpBroadcast:
    case EndpointKind::kUdpPermanentBroadcast:
      return std::make_unique<UdpEndpoint>(options, url, loop, std::move(events));
    case EndpointKind::kTcpClient:
      return std::make_unique<TcpClient>(options, url, loop, std::move(events));
    case EndpointKind::kTcpServer:
      return std::make_unique<TcpServer>(options, url, loop, std::move(events));
    case EndpointKind::kPty:
      return std::make_unique<PtyEndpoint>(options, url, loop, std::move(events));
    case EndpointKind::kSerial:
    case EndpointKind::kSerialHardwareFlow:
      break;
  }
  return std::make_unique<SerialEndpoint>(options, url, loop, std::move(events));
}

}  // namespace trident::bridges
