// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "trident_base/config_types.h"
#include "trident_bridges/modbus/device_identity.h"
#include "trident_bridges/modbus/value.h"

// What a map file says, field by field; register_map.h makes a RegisterMap of it.

namespace trident::bridges::modbus {

/// The four tables of a device (Application Protocol, section 4.3).
enum class Table { kCoil, kDiscrete, kInput, kHolding };
/// For map files.
constexpr auto enum_names(Table) {
  return std::array{EnumName{Table::kCoil, "coil"}, EnumName{Table::kDiscrete, "discrete"},
                    EnumName{Table::kInput, "input"}, EnumName{Table::kHolding, "holding"}};
}

/// What a client may do with a value. All values can be read on the wire; one that is `write` alone
/// is a command, which our client does not poll.
enum class Access { kRead, kWrite, kReadWrite };
/// For map files.
constexpr auto enum_names(Access) {
  return std::array{EnumName{Access::kRead, "read"}, EnumName{Access::kWrite, "write"},
                    EnumName{Access::kReadWrite, "read_write"}};
}

/// How addresses are counted.
enum class Numbering { kZeroBased, kModicon };
/// For map files.
constexpr auto enum_names(Numbering) {
  return std::array{EnumName{Numbering::kZeroBased, "zero_based"},
                    EnumName{Numbering::kModicon, "modicon"}};
}

/// When our client publishes what it has polled.
enum class Publish { kChange, kPoll };
/// For map files.
constexpr auto enum_names(Publish) {
  return std::array{EnumName{Publish::kChange, "change"}, EnumName{Publish::kPoll, "poll"}};
}

/// What frames travel on.
enum class TransportKind { kTcp, kRtu };
/// For map files.
constexpr auto enum_names(TransportKind) {
  return std::array{EnumName{TransportKind::kTcp, "tcp"}, EnumName{TransportKind::kRtu, "rtu"}};
}

/// Of the characters on a serial line.
enum class LineParity { kNone, kEven, kOdd };
/// For map files.
constexpr auto enum_names(LineParity) {
  return std::array{EnumName{LineParity::kNone, "none"}, EnumName{LineParity::kEven, "even"},
                    EnumName{LineParity::kOdd, "odd"}};
}

/// Where the device is, or where it listens.
struct TransportSpec {
  TransportKind kind = TransportKind::kTcp;  ///< decides which of the fields below count
  std::string host = "127.0.0.1";
  std::uint16_t port = 1502;
  std::string device = "/dev/ttyUSB0";
  std::uint32_t baud = 19200;
  LineParity parity = LineParity::kEven;
  int stop_bits = 1;
  bool echo = false;
  double jitter = 0.02;

  /// Lists the fields of `transport`.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("kind", kind, "TCP, or RTU on a serial line");
    ar.field("host", host, "address or name, of tcp");
    ar.field("port", port, Range{1, 65535}, "of tcp");
    ar.field("device", device, "serial device or pseudo-terminal, of rtu");
    ar.field("baud", baud, Range{300, 4'000'000}, "of rtu [bit/s]");
    ar.field("parity", parity, "of rtu");
    ar.field("stop_bits", stop_bits, Range{1, 2}, "of rtu");
    ar.field("echo", echo, "of rtu: the line returns what is sent, as some RS-485 adapters do");
    ar.field("jitter", jitter, Range{0.0, 1.0},
             "of rtu: what driver and operating system may add to the silence within a frame [s]");
  }
};

/// One value, or some of the same type in a row.
struct RegisterSpec {
  std::string name;
  std::optional<Table> table;
  std::uint32_t address = 0;
  int count = 1;
  std::optional<std::string> type;
  double scale = 1.0;
  double offset = 0.0;
  Order words = Order::kBig;
  Order bytes = Order::kBig;
  Access access = Access::kRead;
  std::optional<double> min, max;
  std::optional<double> rate;
  std::optional<double> safe;
  std::optional<double> timeout;
  std::optional<std::string> initial;
  Publish publish = Publish::kChange;
  std::string topic, field = "data", message;
  std::string unit, doc;

  /// Lists the fields of one of `registers`.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("name", name, "for messages and tools");
    ar.field("table", table, "with modicon numbering the address says it, too");
    ar.required("address", address, Range{0, 465536}, "of the first register or bit");
    ar.field("count", count, Range{1, 2000}, "values, for a field that is an array");
    ar.field("type", type,
             "bool, [u]int16, 32 or 64, float32 or 64, string(N) of N characters, bits(NAMES); "
             "default: bool of bits, else uint16");
    ar.field("scale", scale, "the value is scale times what the registers hold, plus offset");
    ar.field("offset", offset, "see scale");
    ar.field("words", words, "which register of a value comes first");
    ar.field("bytes", bytes, "which byte of a register comes first");
    ar.field("access", access, "what clients may do");
    ar.field("min", min, "least legal value that is written; below: exception 3");
    ar.field("max", max, "greatest legal value that is written; above: exception 3");
    ar.field(
        "rate", rate, Range::positive(),
        "greatest change of the value since the last accepted write; faster: exception 6 [1/s]");
    ar.field("safe", safe, "value at start, and when the writer is silent for timeout");
    ar.field("timeout", timeout, Range::positive(), "longest silence of the writer [s]");
    ar.field("initial", initial, "value until there is another one, of what has no safe value");
    ar.field("publish", publish, "a client publishes what has changed, or each poll");
    ar.field("topic", topic, "relative to the node; empty: a value without topic");
    ar.field("field", field, "of the message: a.b, a[2].b; of an array each element in turn");
    ar.field("message", message, "package/Type; default: of std_msgs, by the type");
    ar.field("unit", unit, "of the value, for tools");
    ar.field("doc", doc, "what it is, for tools");
  }
};

/// A map file but for its registers.
struct MapSpec {
  int unit = 1;
  TransportSpec transport;
  Numbering numbering = Numbering::kZeroBased;
  double poll = 10.0;
  double response_timeout = 0.5;
  int retries = 2;
  int pipeline = 1;
  int max_gap = 0;
  double hold = 1.0;
  DeviceIdentity identity;

  /// Lists the fields.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("unit", unit, Range{1, 247}, "of the device");
    ar.field("transport", transport, "");
    ar.field("numbering", numbering, "modicon: 1 coil, 10001 discrete, 30001 input, 40001 holding");
    ar.field("poll", poll, Range{0.001, 10'000.0}, "of a client [Hz]");
    ar.field("response_timeout", response_timeout, Range{0.001, 60.0}, "of a client [s]");
    ar.field("retries", retries, Range{0, 10}, "of a client, after the first attempt");
    ar.field("pipeline", pipeline, Range{1, 16}, "requests of a client in flight, over tcp");
    ar.field("max_gap", max_gap, Range{0, 124},
             "registers between two values that a client reads, too, to save a request");
    ar.field("hold", hold, Range::non_negative(),
             "a value takes no other writer for so long after a write [s]");
    ar.field("identity", identity, "what function 43 / 14 answers");
  }
};

}  // namespace trident::bridges::modbus
