// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "tlog_carrier.h"

#include <cstring>
#include <fstream>
#include <iterator>

#include "trident_base/error.h"
#include "trident_bridges/mavlink/tlog.h"

namespace trident::bridges {
namespace {

using mavlink::Packet;

constexpr std::size_t kWord = sizeof(std::uint64_t);

mavros_msgs::Mavlink as_ros(const Packet& packet) {
  const bool is_2 = packet.version == 2;
  const std::size_t checksum_at =
      (is_2 ? mavlink::kHeader2 : mavlink::kHeader1) + packet.payload.size();
  mavros_msgs::Mavlink message;
  message.framing_status = mavros_msgs::Mavlink::FRAMING_OK;
  message.magic = packet.raw[0];
  message.len = static_cast<std::uint8_t>(packet.payload.size());
  message.incompat_flags = is_2 ? packet.raw[2] : 0;
  message.compat_flags = is_2 ? packet.raw[3] : 0;
  message.seq = packet.sequence;
  message.sysid = packet.source.system;
  message.compid = packet.source.component;
  message.msgid = packet.id;
  message.checksum =
      static_cast<std::uint16_t>(packet.raw[checksum_at] | packet.raw[checksum_at + 1] << 8U);
  message.payload64.resize((packet.payload.size() + kWord - 1) / kWord);
  std::memcpy(message.payload64.data(), packet.payload.data(), packet.payload.size());
  return message;
}

}  // namespace

TlogCarrier::TlogCarrier(const ProbeOptions& options) {
  std::ifstream file(options.tlog, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  mavlink::TlogReader reader(
      mavlink::Bytes(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  while (const auto record = reader.next()) {
    if (record->packet.is_signed || mavlink::target_of(record->packet).system != 0) continue;
    packets_.push_back(as_ros(record->packet));
    keys_.push_back(key_of(packets_.back()));
  }
  if (packets_.empty()) throw Error("--tlog '" + options.tlog + "' has no packets");
}

void TlogCarrier::put(std::uint64_t number, std::size_t /*size*/, Message& message) const {
  message = packets_[number % packets_.size()];
}

std::uint64_t TlogCarrier::number(const Message& message) {
  const std::uint64_t key = key_of(message), size = keys_.size();
  if (next_ > 0 && key == keys_[(next_ - 1) % size]) return next_ - 1;
  for (std::uint64_t ahead = 0; ahead + 1 < size; ++ahead) {
    if (key != keys_[(next_ + ahead) % size]) continue;
    next_ += ahead + 1;
    return next_ - 1;
  }
  return kNoNumber;
}

/// What distinguishes a packet from those near it: its id, checksum, sequence number and sender.
std::uint64_t TlogCarrier::key_of(const Message& message) {
  return std::uint64_t{message.msgid} << 40U | std::uint64_t{message.checksum} << 24U |
         std::uint64_t{message.seq} << 16U | std::uint64_t{message.sysid} << 8U | message.compid;
}

}  // namespace trident::bridges
