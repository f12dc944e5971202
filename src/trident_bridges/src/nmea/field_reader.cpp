// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/field_reader.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace trident::bridges::nmea {
namespace {

constexpr const char* kTimeForm = "hhmmss or hhmmss.ss, up to 235960";
constexpr const char* kDateForm = "ddmmyy, a day of the calendar";
constexpr const char* kNumberForm = "a number such as -12.5";
constexpr const char* kWholeForm = "a whole number";

/// Whether the text is one of the letters.
bool is_letter_of(std::string_view text, const char* letters) {
  return text.size() == 1 && text[0] != '\0' && std::strchr(letters, text[0]) != nullptr;
}

bool parse_time(std::string_view text, TimeOfDay* time) {
  return text.size() >= 6 && parse_digits(text.substr(0, 2), &time->hour) &&
         parse_digits(text.substr(2, 2), &time->minute) && is_digit(text[4]) &&
         parse_number(text.substr(4), &time->second);
}

/// The year is that of the century.
bool parse_date(std::string_view text, CivilDate* date) {
  return text.size() == 6 && parse_digits(text.substr(0, 2), &date->day) &&
         parse_digits(text.substr(2, 2), &date->month) &&
         parse_digits(text.substr(4, 2), &date->year);
}

/// Degrees, and behind them minutes; infinite with 60 minutes or more.
bool parse_angle(std::string_view text, std::size_t degree_digits, double* degrees) {
  int whole = 0;
  double minutes = 0.0;
  const bool is_read =
      text.size() >= degree_digits + 2 && parse_digits(text.substr(0, degree_digits), &whole) &&
      is_digit(text[degree_digits]) && parse_number(text.substr(degree_digits), &minutes);
  *degrees = minutes < 60.0 ? whole + minutes / 60.0 : std::numeric_limits<double>::infinity();
  return is_read;
}

/// A minus may stand in front.
bool parse_whole(std::string_view text, int* value) {
  const bool is_negative = text[0] == '-';
  const bool is_read = parse_digits(text.substr(is_negative ? 1 : 0), value);
  if (is_negative) *value = -*value;
  return is_read;
}

}  // namespace

std::string_view FieldReader::next() {
  const std::size_t index = next_++;
  return index < sentence_.field_count() && !has_failed_ ? sentence_.field(index)
                                                         : std::string_view();
}

std::string_view FieldReader::next_text(const char* name, std::size_t capacity) {
  const std::string_view text = next();
  if (text.size() <= capacity) return text;
  refuse({RefusalKind::kOutOfRange, name, text, "a shorter text"});
  return {};
}

void FieldReader::refuse(const Refusal& refusal) {
  if (!has_failed_) refusal_ = refusal;
  has_failed_ = true;
}

void FieldReader::time(const char* name, std::optional<TimeOfDay>& value) {
  const std::string_view text = next();
  value.reset();
  if (text.empty()) return;
  TimeOfDay time;
  if (!parse_time(text, &time)) {
    refuse({RefusalKind::kNotANumber, name, text, kTimeForm});
  } else if (time.hour > 23 || time.minute > 59 || !(time.second < 61.0)) {
    refuse({RefusalKind::kOutOfRange, name, text, kTimeForm});
  } else {
    value = time;
  }
}

void FieldReader::date(const char* name, std::optional<CivilDate>& value) {
  const std::string_view text = next();
  value.reset();
  if (text.empty()) return;
  CivilDate date;
  if (!parse_date(text, &date)) {
    refuse({RefusalKind::kNotANumber, name, text, kDateForm});
    return;
  }
  date.year += date.year < 80 ? 2000 : 1900;
  if (!is_valid(date)) {
    refuse({RefusalKind::kOutOfRange, name, text, kDateForm});
    return;
  }
  value = date;
}

struct FieldReader::AngleForm {
  std::size_t degree_digits;
  double limit;         ///< [deg]
  const char* letters;  ///< of the positive and the negative side
  const char* form;
  const char* sides;
};

void FieldReader::latitude(const char* name, std::optional<double>& degrees) {
  angle(name, degrees, {2, 90.0, "NS", "ddmm.mmmm", "N or S"});
}

void FieldReader::longitude(const char* name, std::optional<double>& degrees) {
  angle(name, degrees, {3, 180.0, "EW", "dddmm.mmmm", "E or W"});
}

void FieldReader::angle(const char* name, std::optional<double>& degrees, const AngleForm& form) {
  const std::string_view text = next(), side = next();
  degrees.reset();
  if (text.empty()) return;
  double magnitude = 0.0;
  if (!parse_angle(text, form.degree_digits, &magnitude)) {
    refuse({RefusalKind::kNotANumber, name, text, form.form});
  } else if (magnitude > form.limit) {
    refuse({RefusalKind::kOutOfRange, name, text, -form.limit, form.limit});
  } else if (!is_letter_of(side, form.letters)) {
    refuse({RefusalKind::kOutOfRange, name, side, form.sides});
  } else {
    degrees = side[0] == form.letters[0] ? magnitude : -magnitude;
  }
}

void FieldReader::real(const char* name, std::optional<double>& value, const Limits& limits,
                       const NumberFormat& /*format*/) {
  const std::string_view text = next();
  value.reset();
  if (text.empty()) return;
  double number = 0.0;
  if (!parse_number(text, &number)) {
    refuse({RefusalKind::kNotANumber, name, text, kNumberForm});
  } else if (number < limits.lo || number > limits.hi) {
    refuse({RefusalKind::kOutOfRange, name, text, limits.lo, limits.hi});
  } else {
    value = number;
  }
}

void FieldReader::whole(const char* name, std::optional<int>& value, const Limits& limits,
                        int /*min_digits*/) {
  const std::string_view text = next();
  value.reset();
  if (text.empty()) return;
  int number = 0;
  if (!parse_whole(text, &number)) {
    refuse({RefusalKind::kNotANumber, name, text, kWholeForm});
  } else if (number < limits.lo || number > limits.hi) {
    refuse({RefusalKind::kOutOfRange, name, text, limits.lo, limits.hi});
  } else {
    value = number;
  }
}

void FieldReader::sided(const char* name, std::optional<double>& value, const Limits& limits,
                        const NumberFormat& format, const char* letters) {
  real(name, value, limits, format);
  const std::string_view side = next();
  if (!value) return;
  if (!is_letter_of(side, letters)) {
    refuse({RefusalKind::kOutOfRange, name, side, letters});
  } else if (side[0] == letters[1]) {
    value = -*value;
  }
}

void FieldReader::letter(const char* name, char& value, const char* legal) {
  const std::string_view text = next();
  value = '\0';
  if (text.empty()) return;
  if (!is_letter_of(text, legal)) {
    refuse({RefusalKind::kOutOfRange, name, text, legal});
  } else {
    value = text[0];
  }
}

void FieldReader::constant(const char* name, char letter) {
  const std::string_view text = next();
  if (text.empty() || (text.size() == 1 && text[0] == letter)) return;
  refuse({RefusalKind::kOutOfRange, name, text, "another letter, or empty"});
}

void FieldReader::may_end() {
  if (min_count_ == 0) min_count_ = next_;
}

std::size_t FieldReader::count_groups(const char* name, std::size_t fields, std::size_t behind,
                                      std::size_t most) {
  if (next_ >= sentence_.field_count()) return 0;
  const std::size_t left = sentence_.field_count() - next_;
  const std::size_t rest = left % fields;
  const std::size_t groups = left / fields;
  if (rest != 0 && rest != behind) {
    refuse({RefusalKind::kFieldCount, name, static_cast<double>(left), 0.0, 0.0});
    refusal_.legal = "fields in whole groups";
  } else if (groups > most) {
    refuse({RefusalKind::kFieldCount, name, static_cast<double>(groups), 0.0,
            static_cast<double>(most)});
  }
  return groups;
}

bool FieldReader::finish(Refusal* refusal) {
  const auto count = static_cast<double>(sentence_.field_count());
  const auto most = static_cast<double>(next_);
  const double least = min_count_ == 0 ? most : static_cast<double>(min_count_);
  if (count > most || count < least) {
    refuse({RefusalKind::kFieldCount, "number of fields", count, least, most});
  }
  if (has_failed_) *refusal = refusal_;
  return !has_failed_;
}

}  // namespace trident::bridges::nmea
