// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Reads MAVLink from standard input and prints a line of JSON for each message:
//   mavlink_decode [--tlog] [--mavlink1] [--repack] [--key FILE] [--link N] [--signing-time N]
// --tlog: the input is a telemetry log; lines have "time_us", too. --mavlink1: accept it.
// --repack: lines have "packet", the message as our writer sends it, in hexadecimal digits. --key:
// ask for signatures with this key, and sign; the lines of other packets have "refused" alone.
// --link: of our signatures. --signing-time: [10 us] since 2015 at the start; default: the clock's.
// A last line has the counts.
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_bridges/mavlink/message_json.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/packet_writer.h"
#include "trident_bridges/mavlink/signing.h"
#include "trident_bridges/mavlink/tlog.h"

namespace trident::bridges::mavlink {
namespace {

struct Options {
  bool is_tlog = false;
  bool accept_mavlink1 = false;
  bool repack = false;
  std::string key_file;
  std::uint8_t link = 0;
  std::optional<SigningTime> signing_time;
};

Options parse_options(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == words.size()) throw Error(word + " needs a value");
      return words[++i];
    };
    if (word == "--tlog") {
      options.is_tlog = true;
    } else if (word == "--mavlink1") {
      options.accept_mavlink1 = true;
    } else if (word == "--repack") {
      options.repack = true;
    } else if (word == "--key") {
      options.key_file = value();
    } else if (word == "--link") {
      options.link = static_cast<std::uint8_t>(std::stoul(value()));
    } else if (word == "--signing-time") {
      options.signing_time = std::stoull(value());
    } else {
      throw Error("unknown option '" + word +
                  "'; known: --tlog, --mavlink1, --repack, --key, "
                  "--link, --signing-time");
    }
  }
  return options;
}

std::string hex(Bytes bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 0xF];
  }
  return text;
}

SigningTime clock_time() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return signing_time(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

/// Prints packets.
class Printer {
 public:
  explicit Printer(const Options& options) : repack_(options.repack) {
    if (options.key_file.empty()) return;
    signing_ = std::make_unique<Signing>(read_signing_key(options.key_file), nullptr,
                                         options.signing_time.value_or(clock_time()));
    signer_.emplace(*signing_, options.link);
    writer_ = PacketWriter(&*signer_);
  }

  void print(const Packet& packet, const std::string& extra = "") {
    if (signing_ != nullptr) {
      const SignatureVerdict verdict = signing_->check(packet);
      if (verdict != SignatureVerdict::kAccepted) {
        std::printf("{\"refused\": \"%s\"}\n", text_of(verdict));
        return;
      }
    }
    const Message message = to_message(packet);
    std::string line = to_json(message);
    line.pop_back();
    line += extra;
    if (repack_ && packet.is_known) line += ", \"packet\": \"" + hex(writer_.write(message)) + '"';
    std::printf("%s}\n", line.c_str());
  }

 private:
  bool repack_;
  std::unique_ptr<Signing> signing_;
  std::optional<PacketSigner> signer_;
  PacketWriter writer_;
};

void decode_log(Printer& printer) {
  const std::vector<char> log{std::istreambuf_iterator<char>(std::cin),
                              std::istreambuf_iterator<char>()};
  TlogReader reader({reinterpret_cast<const std::uint8_t*>(log.data()), log.size()});
  std::uint64_t records = 0;
  while (const auto record = reader.next()) {
    printer.print(record->packet, ", \"time_us\": " + std::to_string(record->time_us));
    ++records;
  }
  std::printf("{\"packets\": %llu, \"skipped_bytes\": %llu}\n",
              static_cast<unsigned long long>(records),
              static_cast<unsigned long long>(reader.skipped_bytes()));
}

void decode_stream(Printer& printer, bool accept_mavlink1) {
  PacketParser parser(accept_mavlink1);
  std::array<std::uint8_t, 65536> block;
  for (;;) {
    const ssize_t size = ::read(STDIN_FILENO, block.data(), block.size());
    if (size <= 0) break;
    parser.feed(Bytes(block).first(static_cast<std::size_t>(size)));
    while (const std::optional<Packet> packet = parser.next()) printer.print(*packet);
    std::fflush(stdout);
  }
  const ParserCounts& counts = parser.counts();
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf("{\"packets\": %llu, \"unknown\": %llu, \"bad_checksum\": %llu, ",
              number(counts.packets), number(counts.unknown), number(counts.bad_checksum));
  std::printf("\"unknown_flags\": %llu, \"mavlink1\": %llu, \"skipped_bytes\": %llu}\n",
              number(counts.unknown_flags), number(counts.mavlink1), number(counts.skipped_bytes));
}

void run(const Options& options) {
  Printer printer(options);
  if (options.is_tlog) {
    decode_log(printer);
  } else {
    decode_stream(printer, options.accept_mavlink1);
  }
}

}  // namespace
}  // namespace trident::bridges::mavlink

int main(int argc, char** argv) {
  try {
    trident::bridges::mavlink::run(
        trident::bridges::mavlink::parse_options({argv + 1, argv + argc}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mavlink_decode: %s\n", error.what());
    return 2;
  }
}
