// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Measures the MAVLink codec on one core, without ROS and sockets: a line of JSON for each row,
// with CPU time per packet, the rate in Mbit/s of packets, and allocations per packet.
//   mavlink_codec_bench [--seconds S]
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/packet_writer.h"
#include "trident_bridges/mavlink/signing.h"

namespace {

std::uint64_t allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace trident::bridges::mavlink {
namespace {

constexpr std::size_t kPackets = 10'000;  // in a round

double cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Keeps the compiler from leaving out what is measured.
volatile std::uint64_t sink = 0;

Message attitude(std::size_t i) {
  mavlink_attitude_t payload{};
  payload.time_boot_ms = static_cast<std::uint32_t>(i);
  payload.roll = 0.1F + static_cast<float>(i);
  payload.yawspeed = 0.3F;
  return pack(payload, {1, 1});
}

Message odometry(std::size_t i) {
  mavlink_odometry_t payload{};
  payload.time_usec = i;
  std::fill(payload.pose_covariance, payload.pose_covariance + 21, 0.01F);
  std::fill(payload.velocity_covariance, payload.velocity_covariance + 21, 0.01F);
  payload.x = 1.0F + static_cast<float>(i);
  payload.quality = 1;
  return pack(payload, {1, 1});
}

struct Link {
  explicit Link(bool signs)
      : signing({1, 2, 3}, nullptr, 1'000'000'000),
        signer(signing, 1),
        writer(signs ? &signer : nullptr) {}
  Signing signing;
  PacketSigner signer;
  PacketWriter writer;
};

/// One round: packs kPackets messages into `stream`; returns their CPU time [s].
template <class Make>
double pack_round(Link& link, Make make, std::vector<std::uint8_t>& stream) {
  stream.clear();
  const double begin = cpu_s();
  for (std::size_t i = 0; i < kPackets; ++i) {
    const Bytes packet = link.writer.write(make(i));
    stream.insert(stream.end(), packet.begin(), packet.end());
  }
  return cpu_s() - begin;
}

/// One round: finds, checks and decodes the packets of a stream that comes in blocks of 4 KiB.
double parse_round(const std::vector<std::uint8_t>& stream, Signing* signing,
                   PacketParser& parser) {
  constexpr std::size_t kBlock = 4096;
  std::size_t packets = 0;
  const double begin = cpu_s();
  for (std::size_t at = 0; at < stream.size(); at += kBlock) {
    parser.feed(Bytes(stream).subspan(at, std::min(kBlock, stream.size() - at)));
    while (const std::optional<Packet> packet = parser.next()) {
      if (signing != nullptr && signing->check(*packet) != SignatureVerdict::kAccepted) continue;
      const Message message = to_message(*packet);
      sink = sink + message.payload[4];
      ++packets;
    }
  }
  const double end = cpu_s();
  if (packets != kPackets) {
    std::fprintf(stderr, "mavlink_codec_bench: %zu of %zu packets were read\n", packets, kPackets);
    std::exit(1);
  }
  return end - begin;
}

void print_row(const char* name, const char* what, double cpu, std::size_t packets,
               std::size_t bytes, std::uint64_t allocated) {
  std::printf(
      "{\"message\": \"%s\", \"step\": \"%s\", \"packet_bytes\": %.1f, \"cpu_us\": %.4f, "
      "\"mbit_s\": %.0f, \"allocations\": %.4f}\n",
      name, what, static_cast<double>(bytes) / static_cast<double>(packets),
      1e6 * cpu / static_cast<double>(packets), 8e-6 * static_cast<double>(bytes) / cpu,
      static_cast<double>(allocated) / static_cast<double>(packets));
}

template <class Make>
void measure(const char* name, bool signs, Make make, double seconds) {
  Link sender(signs), receiver(signs);
  std::vector<std::uint8_t> stream;
  stream.reserve(kPackets * kMaxPacket);
  PacketParser parser;
  pack_round(sender, make, stream);
  parse_round(stream, signs ? &receiver.signing : nullptr, parser);
  double packing = 0.0, parsing = 0.0;
  std::size_t packets = 0, bytes = 0;
  std::uint64_t pack_allocated = 0, parse_allocated = 0;
  while (packing + parsing < seconds) {
    const std::uint64_t before = allocations;
    packing += pack_round(sender, make, stream);
    const std::uint64_t between = allocations;
    parsing += parse_round(stream, signs ? &receiver.signing : nullptr, parser);
    pack_allocated += between - before;
    parse_allocated += allocations - between;
    packets += kPackets;
    bytes += stream.size();
  }
  print_row(name, signs ? "pack and sign" : "pack", packing, packets, bytes, pack_allocated);
  print_row(name, signs ? "parse and check" : "parse", parsing, packets, bytes, parse_allocated);
  print_row(name, signs ? "both, signed" : "both", packing + parsing, packets, bytes,
            pack_allocated + parse_allocated);
}

}  // namespace
}  // namespace trident::bridges::mavlink

int main(int argc, char** argv) {
  using namespace trident::bridges::mavlink;
  double seconds = 1.0;
  if (argc == 3 && std::strcmp(argv[1], "--seconds") == 0) {
    seconds = std::atof(argv[2]);
  } else if (argc != 1) {
    std::fprintf(stderr, "usage: mavlink_codec_bench [--seconds S]\n");
    return 2;
  }
  for (const bool signs : {false, true}) {
    measure("ATTITUDE", signs, attitude, seconds);
    measure("ODOMETRY", signs, odometry, seconds);
  }
  return 0;
}
