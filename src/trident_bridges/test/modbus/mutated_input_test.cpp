// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Damaged requests, responses, streams and maps: nothing may happen but a refusal.
// TRIDENT_MUTATIONS says how many there are (default 3000).
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "bytes_of_text.h"
#include "trident_bridges/modbus/client.h"
#include "trident_bridges/modbus/device_identity.h"
#include "trident_bridges/modbus/mbap.h"
#include "trident_bridges/modbus/rtu.h"
#include "trident_bridges/modbus/server.h"

namespace trident::bridges::modbus {
namespace {

const char* const kMutatedMap = R"(
unit: 17
registers:
  - {name: pump, table: coil, address: 3, access: read_write}
  - {name: leak, table: discrete, address: 1, count: 20}
  - {name: rpm, table: input, address: 0, type: int16, count: 100}
  - {name: cmd, table: holding, address: 1, type: int16, scale: 0.001, access: write,
     min: -1.0, max: 1.0, safe: 0.25, timeout: 0.5, rate: 2.0}
  - {name: set, table: holding, address: 2, type: float64, access: read_write}
  - {name: text, table: holding, address: 10, type: string(9), access: read_write}
  - {name: bits, table: holding, address: 15, type: bits(a b c), access: read_write}
)";

const char* const kFrames[] = {
    "01 00 03 00 01",       "02 00 01 00 14",
    "03 00 01 00 05",       "04 00 00 00 64",
    "05 00 03 FF 00",       "06 00 01 01 F4",
    "0F 00 03 00 01 01 01", "10 00 02 00 04 08 40 00 00 00 00 00 00 00",
    "16 00 0F 00 F2 00 25", "17 00 01 00 05 00 0F 00 01 02 00 07",
    "2B 0E 01 00",          "2B 0E 04 02",
};

int mutations() {
  const char* const text = std::getenv("TRIDENT_MUTATIONS");
  return text != nullptr ? std::atoi(text) : 3000;
}

/// Random bytes, and frames with some bytes changed, removed or added.
class Mutator {
 public:
  std::vector<std::uint8_t> pdu() {
    if (pick(10) == 0) return noise(pick(300));
    std::vector<std::uint8_t> bytes = bytes_of(kFrames[pick(std::size(kFrames))]);
    for (std::size_t i = pick(4); i > 0; --i) mutate(bytes);
    return bytes;
  }
  std::vector<std::uint8_t> noise(std::size_t size) {
    std::vector<std::uint8_t> bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    return bytes;
  }
  void mutate(std::vector<std::uint8_t>& bytes) {
    const std::size_t at = pick(bytes.size() + 1);
    const auto where = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (pick(3)) {
      case 0:
        if (at < bytes.size()) bytes[at] ^= static_cast<std::uint8_t>(1U << pick(8));
        break;
      case 1:
        if (at < bytes.size()) bytes.erase(where);
        break;
      default:
        bytes.insert(where, static_cast<std::uint8_t>(random_()));
    }
  }
  std::size_t pick(std::size_t below) { return random_() % below; }

 private:
  std::mt19937_64 random_{3};
};

/// What is refused has a text, and what is legal is a request that says the same again.
TEST(ModbusMutations, ARequestIsRefusedWithATextOrWrittenAgainToTheByte) {
  Mutator mutator;
  int legal = 0;
  for (int i = 0; i < mutations(); ++i) {
    const auto bytes = mutator.pdu();
    const DecodedRequest decoded = decode_request(bytes);
    if (!decoded.is_legal) {
      ASSERT_FALSE(decoded.problem.empty()) << hex_of(bytes);
      continue;
    }
    ++legal;
    ASSERT_EQ(hex_of(encode_request(decoded.request).bytes()), hex_of(bytes));
  }
  EXPECT_GT(legal, mutations() / 5);
}

/// Whatever is asked, an answer is one that the client of that request understands.
TEST(ModbusMutations, AServerAnswersEverythingAndKeepsItsLimits) {
  Mutator mutator;
  std::uint64_t refused = 0;
  Server server(parse_register_map(kMutatedMap, "m.yaml"), {{}, [&](const auto&, const auto& text) {
                                                              ++refused;
                                                              ASSERT_LT(text.size(), 400U);
                                                            }});
  const std::size_t cmd = *server.map().find("cmd");
  for (int i = 0; i < mutations(); ++i) {
    const auto bytes = mutator.pdu();
    const Caller caller{static_cast<std::uint32_t>(1 + mutator.pick(3)), "test",
                        mutator.pick(2) == 0};
    const auto unit = static_cast<std::uint8_t>(mutator.pick(2) == 0 ? 17 : mutator.pick(256));
    const auto response = server.handle(caller, unit, bytes, 0.01 * i);
    server.update(0.01 * i);
    if (response) {
      const DecodedRequest decoded = decode_request(bytes);
      ASSERT_LE(response->size(), kMaxPduBytes);
      ASSERT_NE(decode_response(decoded.request, response->bytes()).kind,
                Response::Kind::kMalformed)
          << hex_of(bytes) << " / " << hex_of(response->bytes());
    }
    ASSERT_LE(std::abs(as_double(server.value(cmd).numbers.at(0))), 1.0);
  }
  EXPECT_EQ(refused, server.counts().exceptions);
  EXPECT_GT(server.counts().writes, 0U);
}

TEST(ModbusMutations, AClientTakesAnyAnswer) {
  Mutator mutator;
  Client client(parse_register_map(kMutatedMap, "m.yaml"), true, {});
  for (int i = 0; i < mutations(); ++i) {
    if (i % 5 == 0) client.poll();
    client.set(mutator.pick(client.map().entries.size()),
               {{Number{0.001 * static_cast<double>(mutator.pick(3000))}}, "abc"}, 0.1 * i);
    const auto outgoing = client.next(0.1 * i);
    auto bytes = mutator.pdu();
    if (outgoing && mutator.pick(2) == 0 && !bytes.empty()) bytes[0] = outgoing->pdu.bytes()[0];
    client.receive(outgoing ? std::optional(outgoing->transaction) : std::nullopt, 17, bytes);
    client.update(0.1 * i);
    const auto values = mutator.noise(mutator.pick(40));
    try {
      decode_device_id(values);
    } catch (const Error&) {
    }
  }
  EXPECT_GT(client.counts().responses, 0U);
}

TEST(ModbusMutations, StreamsOfDamagedFramesAreCutWithoutHarm) {
  Mutator mutator;
  std::uint64_t frames = 0;
  RtuFrameReader line(0.004, mutator.pick(2) == 0);
  TcpFrameReader stream;
  double now_s = 0.0;
  for (int i = 0; i < mutations(); ++i) {
    std::vector<std::uint8_t> rtu, tcp;
    auto pdu = mutator.pdu();
    pdu.resize(std::min(pdu.size(), kMaxPduBytes));
    append_rtu_frame(17, pdu, rtu);
    append_tcp_frame({1, 17, pdu}, tcp);
    if (mutator.pick(3) == 0) mutator.mutate(rtu);
    if (mutator.pick(3) == 0) mutator.mutate(tcp);
    line.expect_echo(mutator.pick(4) == 0 ? Bytes(rtu) : Bytes());
    for (std::size_t at = 0; at < rtu.size();) {
      const std::size_t size = std::min(1 + mutator.pick(20), rtu.size() - at);
      line.feed(Bytes(rtu).subspan(at, size), now_s += 0.0005);
      while (line.next(now_s)) ++frames;
      at += size;
    }
    now_s += 0.004 * static_cast<double>(mutator.pick(2));
    while (line.next(now_s)) ++frames;
    if (!stream.problem().empty()) stream = {};
    stream.feed(tcp);
    while (stream.next()) ++frames;
    if (stream.problem().empty()) ASSERT_LT(stream.pending(), kMaxPduBytes + kMbapBytes);
  }
  EXPECT_GT(frames, static_cast<std::uint64_t>(mutations()) / 2);
}

TEST(ModbusMutations, NoiseHoldsFewFrames) {
  Mutator mutator;
  RtuFrameReader line(0.004, false);
  std::uint64_t frames = 0;
  const std::uint64_t bytes = 300ULL * mutations();
  for (std::uint64_t fed = 0, i = 0; fed < bytes; ++i) {
    const auto block = mutator.noise(1 + mutator.pick(300));
    fed += block.size();
    line.feed(block, 0.01 * static_cast<double>(i));
    while (line.next(0.01 * static_cast<double>(i))) ++frames;
    while (line.next(0.01 * static_cast<double>(i) + 0.005)) ++frames;
  }
  // A checksum of 16 bits lets one of 65,536 pass, for each of at most seven places in a block.
  EXPECT_LE(frames, 2 + bytes / 150 * 7 / 10000);
}

TEST(ModbusMutations, ADamagedMapIsReadOrRefusedWithItsFile) {
  Mutator mutator;
  const std::string good = kMutatedMap;
  for (int i = 0; i < mutations() / 5; ++i) {
    std::vector<std::uint8_t> bytes(good.begin(), good.end());
    for (std::size_t k = 1 + mutator.pick(3); k > 0; --k) mutator.mutate(bytes);
    const std::string text(bytes.begin(), bytes.end());
    for (const ConfigError& error : errors_of_map(text, "m.yaml")) {
      ASSERT_EQ(error.file(), "m.yaml");
    }
  }
}

}  // namespace
}  // namespace trident::bridges::modbus
