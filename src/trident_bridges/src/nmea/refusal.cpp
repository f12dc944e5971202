// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/refusal.h"

#include <numeric>

#include "trident_base/string_util.h"

namespace trident::bridges::nmea {
namespace {

constexpr std::array<const char*, kRefusalKinds> kNames{
    "no checksum",   "wrong checksum",         "too long",     "not text",
    "bad address",   "wrong number of fields", "not a number", "out of range",
    "missing field", "bad AIS payload"};

std::string value_text(const Refusal& refusal) {
  if (refusal.is_number) return number_text(refusal.number);
  return "'" + std::string(refusal.value) + "'";
}

}  // namespace

const char* name_of(RefusalKind kind) { return kNames.at(static_cast<std::size_t>(kind)); }

std::string to_text(const Refusal& refusal) {
  std::string legal = refusal.legal;
  if (legal.empty()) {
    legal = "[" + number_text(refusal.lo) + ", " + number_text(refusal.hi) + "]";
  }
  return std::string(refusal.field) + " is " + value_text(refusal) + ", legal: " + legal;
}

std::size_t RefusalCounts::total() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
}

}  // namespace trident::bridges::nmea
