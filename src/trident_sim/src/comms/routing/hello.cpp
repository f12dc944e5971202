// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A byte for the kind, one for the base station, then the fields in their order. Numbers are in
// LEB128, seven bits to a byte and the lowest first, as few of them are large. An entry begins with
// its name's length and has a byte with the share in six bits and two flags: an offer, a request.
#include "comms/routing/hello.h"

#include <limits>

#include "comms/wire.h"

namespace trident::sim {
namespace {

constexpr char kHello = 'H';
constexpr std::uint8_t kHasOffer = 0x40, kHasRequest = 0x80;

void put_number(std::uint32_t value, std::string* to) {
  for (; value >= 0x80; value >>= 7) wire::put(static_cast<std::uint8_t>(value | 0x80), to);
  wire::put(static_cast<std::uint8_t>(value), to);
}

/// Fields with numbers of that form.
class HelloFields : public wire::Fields {
 public:
  using Fields::Fields;

  /// Only the shortest form of a number is one, and only up to 32 bits.
  std::uint32_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const auto next = get<std::uint8_t>();
      value |= std::uint64_t{next & 0x7fU} << shift;
      if (next >= 0x80) continue;
      const bool is_shortest = next != 0 || shift == 0;
      if (!is_shortest || value > std::numeric_limits<std::uint32_t>::max()) break;
      return static_cast<std::uint32_t>(value);
    }
    fail();
    return 0;
  }
};

HelloEntry get_entry(HelloFields* fields) {
  HelloEntry entry;
  entry.robot = fields->text(fields->get<std::uint8_t>());
  const std::uint8_t flags = fields->get<std::uint8_t>();
  entry.heard = flags & kHeardAll;
  if ((flags & kHasOffer) != 0) {
    entry.offer.feasibility = {fields->number(), fields->number()};
    const std::uint64_t metric_ns =
        std::uint64_t{entry.offer.feasibility.distance_ns} + fields->number();
    if (metric_ns >= kNoMetric || entry.offer.feasibility.sequence == 0) fields->fail();
    entry.offer.metric_ns = static_cast<std::uint32_t>(metric_ns);
  }
  if ((flags & kHasRequest) != 0) {
    entry.wanted_sequence = fields->number();
    if (entry.wanted_sequence == 0) fields->fail();
  }
  return entry;
}

}  // namespace

std::string encode(const Hello& hello) {
  std::string bytes(1, kHello);
  wire::put(static_cast<std::uint8_t>(hello.is_base_station), &bytes);
  put_number(hello.number, &bytes);
  put_number(hello.sequence, &bytes);
  for (const HelloEntry& entry : hello.entries) {
    const RouteOffer& offer = entry.offer;
    std::uint8_t flags = entry.heard;
    if (offer.is_route()) flags |= kHasOffer;
    if (entry.wanted_sequence > 0) flags |= kHasRequest;
    wire::put(static_cast<std::uint8_t>(entry.robot.size()), &bytes);
    bytes.append(entry.robot);
    wire::put(flags, &bytes);
    if (offer.is_route()) {
      put_number(offer.feasibility.sequence, &bytes);
      put_number(offer.feasibility.distance_ns, &bytes);
      put_number(offer.metric_ns - offer.feasibility.distance_ns, &bytes);
    }
    if (entry.wanted_sequence > 0) put_number(entry.wanted_sequence, &bytes);
  }
  return bytes;
}

std::optional<Hello> decode_hello(std::string_view bytes) {
  HelloFields fields(bytes);
  const std::uint8_t kind = fields.get<std::uint8_t>();
  const std::uint8_t base_station = fields.get<std::uint8_t>();
  Hello hello;
  hello.is_base_station = base_station == 1;
  hello.number = fields.number();
  hello.sequence = fields.number();
  const bool is_hello = kind == static_cast<std::uint8_t>(kHello) && base_station <= 1 &&
                        hello.number > 0 && hello.sequence > 0;
  if (!is_hello || !fields.is_whole()) return std::nullopt;
  std::string_view last;
  while (!fields.rest().empty()) {
    hello.entries.push_back(get_entry(&fields));
    const std::string_view robot = hello.entries.back().robot;
    if (!fields.is_whole() || robot <= last) return std::nullopt;
    last = robot;
  }
  return hello;
}

}  // namespace trident::sim
