// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/phy/vht.h"

#include <array>

namespace trident::sim::vht {
namespace {

/// Bits that a subcarrier carries, and the code's rate as a fraction.
struct Mode {
  int bits, numerator, denominator;
};

// IEEE 802.11-2016, tables 21-30, 21-38, 21-46: one spatial stream.
constexpr std::array<Mode, kModes> kModeTable{{{1, 1, 2},
                                               {2, 1, 2},
                                               {2, 3, 4},
                                               {4, 1, 2},
                                               {4, 3, 4},
                                               {6, 2, 3},
                                               {6, 3, 4},
                                               {6, 5, 6},
                                               {8, 3, 4},
                                               {8, 5, 6}}};

/// L-STF, L-LTF, L-SIG, VHT-SIG-A, VHT-STF, one VHT-LTF
/// and VHT-SIG-B; the legacy one ends at L-SIG.
constexpr std::int64_t kVhtPreamble_ns = 40000;
constexpr std::int64_t kLegacyPreamble_ns = 20000;
/// Of the SERVICE field and of the tail that empties the convolutional coder.
constexpr std::size_t kServiceAndTailBits = 16 + 6;

int data_subcarriers(int width_mhz) {
  if (width_mhz == 80) return 234;
  return width_mhz == 40 ? 108 : 52;
}

std::int64_t symbols(std::size_t bytes, int bits_per_symbol) {
  const auto bits = static_cast<std::int64_t>(8 * bytes + kServiceAndTailBits);
  return (bits + bits_per_symbol - 1) / bits_per_symbol;
}

}  // namespace

bool is_mode(int mcs, int width_mhz) {
  // MCS 9 is not defined for one stream at 20 MHz: its bits do not fill symbols.
  const bool is_width = width_mhz == 20 || width_mhz == 40 || width_mhz == 80;
  return is_width && mcs >= 0 && mcs < kModes && !(mcs == 9 && width_mhz == 20);
}

int bits_per_symbol(int mcs, int width_mhz) {
  const Mode& mode = kModeTable[static_cast<std::size_t>(mcs)];
  return data_subcarriers(width_mhz) * mode.bits * mode.numerator / mode.denominator;
}

double data_rate(int mcs, int width_mhz, bool has_short_guard) {
  // A symbol lasts 3.2 us and a guard interval of 0.4 or 0.8 us.
  return bits_per_symbol(mcs, width_mhz) / (has_short_guard ? 3.6e-6 : 4e-6);
}

std::int64_t duration_ns(int mcs, int width_mhz, bool has_short_guard, std::size_t bytes) {
  const std::int64_t count = symbols(bytes, bits_per_symbol(mcs, width_mhz));
  // With the short guard interval a frame still ends at a whole long symbol.
  const std::int64_t data_ns = has_short_guard ? (count * 3600 + 3999) / 4000 * 4000 : count * 4000;
  return kVhtPreamble_ns + data_ns;
}

std::size_t subframe_bytes(std::size_t frame_bytes) {
  // Subframes of an A-MPDU are padded to four bytes.
  return (kDelimiterBytes + frame_bytes + 3) / 4 * 4;
}

std::int64_t legacy_duration_ns(int mbit_s, std::size_t bytes) {
  // One Mbit/s is four bits in a symbol of 4 us.
  return kLegacyPreamble_ns + symbols(bytes, 4 * mbit_s) * 4000;
}

/// The highest mandatory rate, 6, 12 or 24 Mbit/s, that is not above that of the data.
int control_rate(int mcs) {
  if (mcs >= 3) return 24;
  return mcs >= 1 ? 12 : 6;
}

std::int64_t ack_duration_ns(int mcs, std::size_t subframes) {
  return legacy_duration_ns(control_rate(mcs), subframes > 1 ? kBlockAckBytes : kAckBytes);
}

int equal_mcs(int legacy_mbit_s) {
  if (legacy_mbit_s >= 24) return 3;
  return legacy_mbit_s >= 12 ? 1 : 0;
}

}  // namespace trident::sim::vht
