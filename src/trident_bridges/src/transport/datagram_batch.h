// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "transport/socket_address.h"
#include "trident_bridges/transport/endpoint.h"

namespace trident::bridges {

/// Datagrams that are read from a socket with one system call, into memory that is taken once.
class DatagramBatch {
 public:
  static constexpr std::size_t kCapacity = 32;             ///< datagrams
  static constexpr std::size_t kLongestDatagram = 65'535;  ///< bytes; UDP has no longer ones

  /// Takes address space for the longest datagrams; memory is used by those that come.
  DatagramBatch();
  DatagramBatch(const DatagramBatch&) = delete;
  DatagramBatch& operator=(const DatagramBatch&) = delete;

  /// Reads what a socket has, without waiting. Returns the number of datagrams; 0 also when the
  /// socket has an error, which it has no longer then.
  std::size_t read(int socket);

  /// The bytes of datagram `index` of the last read().
  Bytes bytes(std::size_t index) const;
  /// Where it came from.
  const SocketAddress& source(std::size_t index) const { return sources_[index]; }
  /// How many datagrams that did not fit the receive buffer the kernel had dropped before this one
  /// came, modulo 2^32 and since the socket was opened; nullopt: it does not say (SO_RXQ_OVFL of
  /// socket(7)).
  std::optional<std::uint32_t> kernel_drops(std::size_t index) const;

 private:
  static constexpr std::size_t kControlSize = CMSG_SPACE(sizeof(std::uint32_t));

  std::unique_ptr<std::uint8_t[]> memory_;  // not a vector: it is not touched before use
  std::array<mmsghdr, kCapacity> headers_{};
  std::array<iovec, kCapacity> parts_{};
  std::array<SocketAddress, kCapacity> sources_;
  alignas(cmsghdr) std::array<std::array<std::uint8_t, kControlSize>, kCapacity> controls_{};
};

}  // namespace trident::bridges
