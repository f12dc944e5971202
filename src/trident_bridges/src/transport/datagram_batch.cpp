// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/datagram_batch.h"

#include <cstring>

namespace trident::bridges {

DatagramBatch::DatagramBatch() : memory_(new std::uint8_t[kCapacity * kLongestDatagram]) {
  for (std::size_t i = 0; i < kCapacity; ++i) {
    parts_[i] = {memory_.get() + i * kLongestDatagram, kLongestDatagram};
  }
}

std::size_t DatagramBatch::read(int socket) {
  for (std::size_t i = 0; i < kCapacity; ++i) {
    msghdr& header = headers_[i].msg_hdr;
    header.msg_name = sources_[i].get();
    header.msg_namelen = sizeof(sources_[i].storage);
    header.msg_iov = &parts_[i];
    header.msg_iovlen = 1;
    header.msg_control = controls_[i].data();
    header.msg_controllen = kControlSize;
  }
  const int count = recvmmsg(socket, headers_.data(), kCapacity, MSG_DONTWAIT, nullptr);
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    sources_[index].size = headers_[index].msg_hdr.msg_namelen;
  }
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

Bytes DatagramBatch::bytes(std::size_t index) const {
  return {memory_.get() + index * kLongestDatagram, headers_[index].msg_len};
}

std::optional<std::uint32_t> DatagramBatch::kernel_drops(std::size_t index) const {
  msghdr header = headers_[index].msg_hdr;
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SO_RXQ_OVFL) continue;
    std::uint32_t drops = 0;
    std::memcpy(&drops, CMSG_DATA(part), sizeof(drops));
    return drops;
  }
  return std::nullopt;
}

}  // namespace trident::bridges
