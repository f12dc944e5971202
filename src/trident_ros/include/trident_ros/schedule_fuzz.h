// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::ros_utils {

/// A place where one thread or process hands over to another: a message received, a lock taken, a
/// service asked. In tests that set TRIDENT_SCHEDULE_FUZZ to a seed, it is delayed by a random
/// time, mostly none, now and then 0.1 to 500 ms, so that schedules come about that a machine at
/// rest never sees. The delays are a function of the seed, the program, the place and how often the
/// thread was there. Otherwise it costs the reading of a constant.
void delay_hand_over(const char* place);

namespace schedule_fuzz {
extern const bool is_active;  ///< whether TRIDENT_SCHEDULE_FUZZ was set as the program began
}

/// `place` names the hand-over for the seed; a constant text.
inline void hand_over(const char* place) {
  if (schedule_fuzz::is_active) delay_hand_over(place);
}

}  // namespace trident::ros_utils
