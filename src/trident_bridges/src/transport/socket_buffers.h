// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace trident::bridges {

/// Asks the kernel for buffers of these sizes [bytes] and returns what it gave as a sentence for
/// the log: "receive buffer 212992 bytes of 4194304 (net.core.rmem_max), send buffer ...". The
/// kernel counts its own bookkeeping in them (socket(7)).
std::string set_socket_buffers(int socket, std::uint32_t receive_bytes, std::uint32_t send_bytes);

}  // namespace trident::bridges
