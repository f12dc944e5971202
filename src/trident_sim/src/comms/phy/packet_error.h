// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace trident::sim {

/// Probability that a frame of so many bytes is lost, in white noise at a ratio of signal to noise
/// in the channel's width [dB]. `mcs` 0 to 9.
///
/// The curve of each mode is that of ns-3 3.37's table-based error model (link simulations of
/// convolutional codes): through its ratios at losses of 1, 10 and 90 % for 1500 bytes, and at 10 %
/// for 100 bytes, with which short frames, below 400 bytes, are computed as there. Between and
/// beyond the points, ln(-ln(1 - loss)) is a straight line over the ratio; lengths count by
/// 1 - loss = (1 - loss of the reference)^(bytes / reference).
double packet_error_rate(int mcs, double snr_db, std::size_t bytes);

/// Power of thermal noise in a channel, -174 dBm/Hz and the receiver's own [dBm].
double noise_power_dbm(double width_mhz, double noise_figure_db);

}  // namespace trident::sim
