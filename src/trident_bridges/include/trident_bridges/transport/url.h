// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trident::bridges {

/// What kind of endpoint a URL names.
enum class EndpointKind {
  kUdp,                    ///< udp://
  kUdpBroadcast,           ///< udp-b://: broadcasts until a peer answers
  kUdpPermanentBroadcast,  ///< udp-pb://
  kTcpClient,              ///< tcp://
  kTcpServer,              ///< tcp-l://
  kSerial,                 ///< serial://, a path in /dev
  kSerialHardwareFlow,     ///< serial-hwfc://: with RTS and CTS
  kPty,                    ///< pty://
};

/// A URL of an endpoint, in the forms that mavros reads:
/// - udp://[bind][:port]@[host][:port][/?ids=system,component], udp-b:// and udp-pb:// alike;
/// - tcp://[host][:port], tcp-l://[bind][:port], both with [/?ids=...];
/// - /dev/tty[:baud], serial://device[:baud][?ids=...], serial-hwfc://device[:baud];
/// - and pty://link[:baud]: a symbolic link to the far end of a pseudo-terminal of ours.
/// IPv6 addresses stand in brackets.
struct EndpointUrl {
  EndpointKind kind = EndpointKind::kUdp;
  std::string bind_host;                     ///< UDP, TCP server; empty: loopback
  std::optional<std::uint16_t> bind_port;    ///< UDP, TCP server
  std::string host;                          ///< UDP: empty: peers are learnt; TCP client
  std::optional<std::uint16_t> port;         ///< of `host`
  std::string device;                        ///< serial device, or the link of a pseudo-terminal
  std::optional<std::uint32_t> baud;         ///< [bit/s]
  std::optional<std::uint8_t> system_id;     ///< of ?ids=
  std::optional<std::uint8_t> component_id;  ///< of ?ids=
};

/// Throws Error with the URL, the field, the value and the legal range.
EndpointUrl parse_endpoint_url(std::string_view text);

}  // namespace trident::bridges
