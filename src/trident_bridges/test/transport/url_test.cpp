// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/transport/url.h"

#include <gtest/gtest.h>

#include "trident_base/error.h"
#include "trident_base/random_stream.h"

namespace trident::bridges {
namespace {

std::string message_of(const std::string& text) {
  try {
    parse_endpoint_url(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Url, UdpHasTwoEndsEachOfWhichMayBeLeftOut) {
  const EndpointUrl url = parse_endpoint_url("udp://:14540@192.168.1.100:14557");
  EXPECT_EQ(url.kind, EndpointKind::kUdp);
  EXPECT_EQ(url.bind_host, "");
  EXPECT_EQ(url.bind_port, 14540);
  EXPECT_EQ(url.host, "192.168.1.100");
  EXPECT_EQ(url.port, 14557);
  const EndpointUrl learns = parse_endpoint_url("udp://:14550@");
  EXPECT_EQ(learns.host, "");
  EXPECT_FALSE(learns.port);
  const EndpointUrl defaults = parse_endpoint_url("udp://@");
  EXPECT_FALSE(defaults.bind_port);
  EXPECT_EQ(parse_endpoint_url("udp-b://@").kind, EndpointKind::kUdpBroadcast);
  EXPECT_EQ(parse_endpoint_url("udp-pb://127.0.0.1:1@").kind, EndpointKind::kUdpPermanentBroadcast);
}

TEST(Url, IdsStandBehindASlash) {
  const EndpointUrl url = parse_endpoint_url("udp://127.0.0.1:14540@127.0.0.1/?ids=2,240");
  EXPECT_EQ(url.host, "127.0.0.1");
  EXPECT_FALSE(url.port);
  EXPECT_EQ(url.system_id, 2);
  EXPECT_EQ(url.component_id, 240);
  EXPECT_EQ(parse_endpoint_url("/dev/ttyUSB0:921600?ids=1,1").baud, 921600U);
}

TEST(Url, TcpHasOneEnd) {
  const EndpointUrl client = parse_endpoint_url("tcp://localhost:5760/");
  EXPECT_EQ(client.kind, EndpointKind::kTcpClient);
  EXPECT_EQ(client.host, "localhost");
  EXPECT_EQ(client.port, 5760);
  const EndpointUrl server = parse_endpoint_url("tcp-l://:5760");
  EXPECT_EQ(server.kind, EndpointKind::kTcpServer);
  EXPECT_EQ(server.bind_port, 5760);
  EXPECT_EQ(parse_endpoint_url("tcp-l://[::1]:5760").bind_host, "::1");
}

TEST(Url, ADeviceKeepsItsColonsAndSlashes) {
  const EndpointUrl plain = parse_endpoint_url("/dev/ttyACM0:57600");
  EXPECT_EQ(plain.kind, EndpointKind::kSerial);
  EXPECT_EQ(plain.device, "/dev/ttyACM0");
  EXPECT_EQ(plain.baud, 57600U);
  const EndpointUrl by_path = parse_endpoint_url("serial:///dev/serial/by-path/pci-0:1.0-port0");
  EXPECT_EQ(by_path.device, "/dev/serial/by-path/pci-0:1.0-port0");
  EXPECT_FALSE(by_path.baud);
  EXPECT_EQ(parse_endpoint_url("serial-hwfc:///dev/ttyS0:115200").kind,
            EndpointKind::kSerialHardwareFlow);
  EXPECT_EQ(parse_endpoint_url("pty:///run/x/gps:4800").device, "/run/x/gps");
}

TEST(Url, AnErrorNamesUrlFieldAndLegalRange) {
  EXPECT_EQ(message_of("udp://:70000@"),
            "url 'udp://:70000@': bind port '70000' is not legal; legal: 0 to 65535");
  EXPECT_NE(message_of("udp://:14550").find("'@' is missing"), std::string::npos);
  EXPECT_NE(message_of("upd://@").find("did you mean 'udp'"), std::string::npos);
  EXPECT_NE(message_of("tcp://host:http").find("host port 'http' is not legal"), std::string::npos);
  EXPECT_NE(message_of("udp://@/?id=1,1").find("legal: ids=SYSTEM,COMPONENT"), std::string::npos);
  EXPECT_NE(message_of("udp://@/?ids=0,1").find("legal: 1"), std::string::npos);
  EXPECT_NE(message_of("udp://@/?ids=7").find("two numbers"), std::string::npos);
  EXPECT_NE(message_of("serial://:57600").find("device is missing"), std::string::npos);
  EXPECT_NE(message_of("serial:///dev/ttyS0:5").find("baud"), std::string::npos);
  EXPECT_NE(message_of("tcp://[::1:5760").find("']' is missing"), std::string::npos);
  EXPECT_NE(message_of("tcp://[::1]5760").find("only :port"), std::string::npos);
  EXPECT_NE(message_of("tcp://a/b:1").find("is no host"), std::string::npos);
}

TEST(Url, AnythingIsParsedOrRefused) {
  const std::string all = "udp://-b:@127.0.0.1:14550/?ids=1,2[::]/dev/tty serial-hwfc pty\x00\xff%";
  const RandomStream random(1, "urls");
  std::uint64_t draw = 0;
  int parsed = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = i % 2 == 0 ? "udp://" : "";
    const auto length = random.bits(draw++, 0) % 20;
    for (std::uint64_t k = 0; k < length; ++k) text += all[random.bits(draw++, 0) % all.size()];
    try {
      parse_endpoint_url(text);
      ++parsed;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(parsed, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace trident::bridges
