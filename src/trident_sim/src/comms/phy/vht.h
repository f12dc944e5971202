// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace trident::sim {

/// Rates and durations of IEEE 802.11ac (VHT) with one spatial stream at 5 GHz, and of the OFDM
/// frames (802.11a) that control and broadcast frames are sent as.
namespace vht {

constexpr int kModes = 10;  ///< MCS 0 to 9

/// Of the medium access at 5 GHz (IEEE 802.11-2016, table 17-21 and 9-137 for best effort) [ns].
constexpr std::int64_t kSlot_ns = 9000;
constexpr std::int64_t kSifs_ns = 16000;             ///< between a frame and its answer
constexpr std::int64_t kAifs_ns = 16000 + 3 * 9000;  ///< before a contention, AIFSN 3
constexpr int kMinWindow = 15;                       ///< CWmin [slots]
constexpr int kMaxWindow = 1023;                     ///< CWmax [slots]
constexpr std::int64_t kMaxDuration_ns = 5484000;    ///< of a VHT frame
constexpr std::size_t kMaxSubframes = 64;            ///< that one block acknowledgement covers
/// Bytes of a QoS data frame besides what the user sends: MAC header 26, checksum 4, LLC and
/// SNAP 8.
constexpr std::size_t kFrameBytes = 38;
constexpr std::size_t kDelimiterBytes = 4;  ///< before each subframe of an A-MPDU
constexpr std::size_t kAckBytes = 14;
constexpr std::size_t kBlockAckBytes = 32;
constexpr std::size_t kRequestBytes = 24;  ///< that ask for a block acknowledgement

/// Whether there is such a mode: MCS 9 has no whole number of bits per symbol at 20 MHz.
/// `width_mhz`: 20, 40 or 80.
bool is_mode(int mcs, int width_mhz);

/// Data bits of an OFDM symbol. Precondition: is_mode().
int bits_per_symbol(int mcs, int width_mhz);

/// Of the data alone, with the long guard interval (symbols of 4 us) or the short one (3.6 us)
/// [bit/s].
double data_rate(int mcs, int width_mhz, bool has_short_guard);

/// Of a frame of so many bytes, its preamble of 40 us included [ns].
std::int64_t duration_ns(int mcs, int width_mhz, bool has_short_guard, std::size_t bytes);

/// Of a subframe in an A-MPDU: with its delimiter, padded to four bytes.
std::size_t subframe_bytes(std::size_t frame_bytes);

/// Of a frame at 6, 12 or 24 Mbit/s in 20 MHz, its preamble of 20 us included [ns].
std::int64_t legacy_duration_ns(int mbit_s, std::size_t bytes);

/// The rate of the frame that acknowledges one: the highest of 6, 12, 24 Mbit/s whose modulation
/// and code are no weaker than those of the data [Mbit/s].
int control_rate(int mcs);

/// Of the frame that acknowledges a number of subframes, a block acknowledgement from two on [ns].
std::int64_t ack_duration_ns(int mcs, std::size_t subframes);

/// The MCS whose modulation and code a frame at 6, 12 or 24 Mbit/s has.
int equal_mcs(int legacy_mbit_s);

}  // namespace vht
}  // namespace trident::sim
