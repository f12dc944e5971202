// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A byte for the kind, then the fields in their order, each with its lowest byte first.
#include "comms/relay/datagram.h"

#include <algorithm>

#include "comms/wire.h"

namespace trident::sim {
namespace {

constexpr char kPart = 'P', kAck = 'A';

using wire::Fields;
using wire::put;

}  // namespace

std::string encode(const PartDatagram& part) {
  std::string bytes(1, kPart);
  put(part.rule, &bytes);
  put(part.number, &bytes);
  put(part.oldest, &bytes);
  put(part.part, &bytes);
  put(part.parts, &bytes);
  put(part.born.ns, &bytes);
  return bytes.append(part.data);
}

std::string encode(const AckDatagram& ack) {
  std::string bytes(1, kAck);
  put(ack.rule, &bytes);
  put(ack.next, &bytes);
  for (const std::uint64_t number : ack.beyond) put(number, &bytes);
  return bytes;
}

std::optional<PartDatagram> decode_part(std::string_view bytes) {
  Fields fields(bytes);
  const char kind = fields.get<char>();
  PartDatagram part;
  part.rule = fields.get<std::uint16_t>();
  part.number = fields.get<std::uint64_t>();
  part.oldest = fields.get<std::uint64_t>();
  part.part = fields.get<std::uint16_t>();
  part.parts = fields.get<std::uint16_t>();
  part.born.ns = fields.get<std::int64_t>();
  part.data = fields.rest();
  // No parts at all is a skip: it only says which number is the oldest that is still offered.
  const bool is_part = part.part < part.parts || (part.part == 0 && part.parts == 0);
  if (kind != kPart || !fields.is_whole() || !is_part) return std::nullopt;
  return part;
}

std::optional<AckDatagram> decode_ack(std::string_view bytes) {
  Fields fields(bytes);
  const char kind = fields.get<char>();
  AckDatagram ack;
  ack.rule = fields.get<std::uint16_t>();
  ack.next = fields.get<std::uint64_t>();
  while (fields.is_whole() && !fields.rest().empty()) {
    ack.beyond.push_back(fields.get<std::uint64_t>());
  }
  if (kind != kAck || !fields.is_whole()) return std::nullopt;
  return ack;
}

std::size_t part_count(std::size_t bytes) {
  return std::max<std::size_t>((bytes + kPartBytes - 1) / kPartBytes, 1);
}

}  // namespace trident::sim
