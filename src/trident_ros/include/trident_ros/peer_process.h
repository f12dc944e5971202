// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

namespace trident::ros_utils {

/// Process at the other end of a connected TCP socket. 0 when it is not on this machine, or not to
/// be seen from here: another user's, or one in another container. Looks through /proc, which takes
/// milliseconds.
pid_t peer_process(int descriptor);

}  // namespace trident::ros_utils
