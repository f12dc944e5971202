// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/transport/url.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

constexpr std::int64_t kLongestBaud = 4'000'000;

struct Scheme {
  const char* name;
  EndpointKind kind;
};
constexpr std::array<Scheme, 8> kSchemes{{{"udp", EndpointKind::kUdp},
                                          {"udp-b", EndpointKind::kUdpBroadcast},
                                          {"udp-pb", EndpointKind::kUdpPermanentBroadcast},
                                          {"tcp", EndpointKind::kTcpClient},
                                          {"tcp-l", EndpointKind::kTcpServer},
                                          {"serial", EndpointKind::kSerial},
                                          {"serial-hwfc", EndpointKind::kSerialHardwareFlow},
                                          {"pty", EndpointKind::kPty}}};

// One URL being parsed: its errors begin with it.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  EndpointUrl parse() {
    const std::string_view rest = take_query(take_scheme(text_));
    switch (url_.kind) {
      case EndpointKind::kUdp:
      case EndpointKind::kUdpBroadcast:
      case EndpointKind::kUdpPermanentBroadcast:
        parse_udp(rest);
        break;
      case EndpointKind::kTcpClient:
        std::tie(url_.host, url_.port) = host_and_port(rest, "host");
        break;
      case EndpointKind::kTcpServer:
        std::tie(url_.bind_host, url_.bind_port) = host_and_port(rest, "bind");
        break;
      default:
        parse_device(rest);
    }
    return std::move(url_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("url '" + std::string(text_) + "': " + what);
  }

  EndpointKind kind_of(std::string_view name) const {
    std::vector<std::string> known;
    for (const Scheme& scheme : kSchemes) {
      if (name == scheme.name) return scheme.kind;
      known.emplace_back(scheme.name);
    }
    fail("scheme " + unknown_name_text(name, known));
  }

  std::int64_t number(const std::string& field, std::string_view text, std::int64_t lo,
                      std::int64_t hi) const {
    std::int64_t value = -1;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || value < lo || value > hi) {
      fail(field + " '" + std::string(text) + "' is not legal; legal: " + std::to_string(lo) +
           " to " + std::to_string(hi));
    }
    return value;
  }

  // Reads the kind and returns what stands behind it.
  std::string_view take_scheme(std::string_view text) {
    const auto scheme_end = text.find("://");
    if (scheme_end == std::string_view::npos) {
      url_.kind = EndpointKind::kSerial;
      return text;
    }
    url_.kind = kind_of(text.substr(0, scheme_end));
    return text.substr(scheme_end + 3);
  }

  // Reads "?ids=system,component" and returns what stands before it, without the slash.
  std::string_view take_query(std::string_view rest) {
    const auto question = rest.find('?');
    if (question == std::string_view::npos) return without_slash(rest);
    const std::string_view query = rest.substr(question + 1);
    if (!starts_with(query, "ids=")) {
      fail("query '" + std::string(query) + "' is unknown; legal: ids=SYSTEM,COMPONENT");
    }
    const std::string_view ids = query.substr(4);
    const auto comma = ids.find(',');
    if (comma == std::string_view::npos) fail("ids: two numbers are needed: ids=SYSTEM,COMPONENT");
    url_.system_id = static_cast<std::uint8_t>(number("system id", ids.substr(0, comma), 1, 255));
    url_.component_id =
        static_cast<std::uint8_t>(number("component id", ids.substr(comma + 1), 0, 255));
    return without_slash(rest.substr(0, question));
  }

  std::string_view without_slash(std::string_view rest) const {
    const bool is_device = url_.kind == EndpointKind::kSerial || url_.kind == EndpointKind::kPty ||
                           url_.kind == EndpointKind::kSerialHardwareFlow;
    if (!is_device && ends_with(rest, "/")) rest.remove_suffix(1);
    return rest;
  }

  void parse_udp(std::string_view rest) {
    const auto at = rest.find('@');
    if (at == std::string_view::npos) {
      fail("'@' is missing; legal: udp://[bind][:port]@[host][:port]");
    }
    std::tie(url_.bind_host, url_.bind_port) = host_and_port(rest.substr(0, at), "bind");
    std::tie(url_.host, url_.port) = host_and_port(rest.substr(at + 1), "host");
  }

  std::pair<std::string, std::optional<std::uint16_t>> host_and_port(std::string_view text,
                                                                     const char* field) const {
    std::size_t colon = text.find(':');
    std::string_view host = text.substr(0, std::min(colon, text.size()));
    if (starts_with(text, "[")) {
      const auto bracket = text.find(']');
      if (bracket == std::string_view::npos) fail(std::string(field) + ": ']' is missing");
      host = text.substr(1, bracket - 1);
      colon = bracket + 1 < text.size() ? bracket + 1 : std::string_view::npos;
      if (colon != std::string_view::npos && text[colon] != ':') {
        fail(std::string(field) + ": only :port may follow ']'");
      }
    }
    if (host.find_first_of("/ @") != std::string_view::npos) {
      fail(std::string(field) + " '" + std::string(host) + "' is no host");
    }
    std::optional<std::uint16_t> port;
    if (colon != std::string_view::npos) {
      port = static_cast<std::uint16_t>(
          number(std::string(field) + " port", text.substr(colon + 1), 0, 65535));
    }
    return {std::string(host), port};
  }

  // Devices such as /dev/serial/by-path/pci-0:1.0 contain colons: a baud rate is the digits alone.
  /// Else it is part of a path.
  static bool is_baud(std::string_view tail) {
    return !tail.empty() && std::isdigit(static_cast<unsigned char>(tail[0])) != 0 &&
           tail.find_first_of("/.") == std::string_view::npos;
  }

  void parse_device(std::string_view rest) {
    const auto colon = rest.rfind(':');
    const std::string_view tail =
        colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
    if (is_baud(tail)) {
      url_.baud = static_cast<std::uint32_t>(number("baud", tail, 50, kLongestBaud));
      rest = rest.substr(0, colon);
    }
    url_.device = std::string(rest);
    if (url_.device.empty()) fail("device is missing; legal: a path, such as /dev/ttyACM0:57600");
  }

  std::string_view text_;
  EndpointUrl url_;
};

}  // namespace

EndpointUrl parse_endpoint_url(std::string_view text) { return Parser(text).parse(); }

}  // namespace trident::bridges
