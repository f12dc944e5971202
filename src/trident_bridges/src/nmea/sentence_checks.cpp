// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Rules across the fields of sentences.
#include "trident_bridges/nmea/sentences/ais_part.h"
#include "trident_bridges/nmea/sentences/position.h"
#include "trident_bridges/nmea/sentences/route.h"

namespace trident::bridges::nmea {
namespace {

constexpr const char* kTimeNeeded = "hhmmss.ss, where there is a fix";
constexpr const char* kPlaceNeeded = "a position, where there is a fix";

bool has_place(const std::optional<double>& latitude, const std::optional<double>& longitude,
               const char* legal, Refusal* refusal) {
  if (!latitude) return refuse_missing("latitude", legal, refusal);
  return longitude || refuse_missing("longitude", legal, refusal);
}

/// Number and total of a sentence that is one of several.
bool is_part(const std::optional<int>& number, const std::optional<int>& total, Refusal* refusal) {
  if (!total) return refuse_missing("number of sentences", "at least 1", refusal);
  if (!number) return refuse_missing("sentence", "from 1 to the number of sentences", refusal);
  if (*number <= *total) return true;
  *refusal = {RefusalKind::kOutOfRange, "sentence", static_cast<double>(*number), 1.0,
              static_cast<double>(*total)};
  return false;
}

}  // namespace

bool refuse_missing(const char* field, const char* legal, Refusal* refusal) {
  *refusal = {RefusalKind::kMissing, field, "", legal};
  return false;
}

bool Gga::check(Refusal* refusal) const {
  if (!quality) return refuse_missing("quality", "a number from 0 to 8", refusal);
  if (*quality == kNoFix) return true;
  if (!time) return refuse_missing("UTC", kTimeNeeded, refusal);
  return has_place(latitude_deg, longitude_deg, kPlaceNeeded, refusal);
}

bool Gll::check(Refusal* refusal) const {
  if (status != 'A') return true;
  if (!time) return refuse_missing("UTC", kTimeNeeded, refusal);
  return has_place(latitude_deg, longitude_deg, kPlaceNeeded, refusal);
}

bool Rmc::check(Refusal* refusal) const {
  if (status != 'A') return true;
  if (!time) return refuse_missing("UTC", kTimeNeeded, refusal);
  if (!date) return refuse_missing("date", "ddmmyy, where there is a fix", refusal);
  return has_place(latitude_deg, longitude_deg, kPlaceNeeded, refusal);
}

bool Zda::check(Refusal* refusal) const {
  if (!time || date()) return true;
  if (!day) return refuse_missing("day", "a day of the calendar", refusal);
  if (!month) return refuse_missing("month", "a day of the calendar", refusal);
  if (!year) return refuse_missing("year", "a day of the calendar", refusal);
  *refusal = {RefusalKind::kOutOfRange, "day", static_cast<double>(*day), 1.0, 31.0};
  refusal->legal = "a day of that month";
  return false;
}

std::optional<CivilDate> Zda::date() const {
  if (!day || !month || !year) return std::nullopt;
  const CivilDate date{*year, *month, *day};
  return is_valid(date) ? std::optional<CivilDate>(date) : std::nullopt;
}

bool Wpl::check(Refusal* refusal) const {
  if (name.empty()) return refuse_missing("name", "a name", refusal);
  return has_place(latitude_deg, longitude_deg, "the place of the waypoint", refusal);
}

bool Rte::check(Refusal* refusal) const { return is_part(number, total, refusal); }

bool AisPart::check(Refusal* refusal) const {
  if (!is_part(number, total, refusal)) return false;
  return !payload.empty() || refuse_missing("payload", "characters of six bits", refusal);
}

}  // namespace trident::bridges::nmea
