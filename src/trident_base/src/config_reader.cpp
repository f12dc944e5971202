// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/config_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

namespace trident::config_detail {
namespace {

using Kind = ConfigNode::Kind;

template <std::size_t N>
bool is_one_of(std::string_view text, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

bool is_plain_scalar(const ConfigNode& node) { return node.kind == Kind::kScalar && !node.quoted; }

std::string with_unit(const std::string& legal, const std::string& unit) {
  return unit.empty() ? legal : legal + ' ' + unit;
}

std::string number_expected(const ValueContext& context) {
  return with_unit(
      context.range.is_unbounded() ? "a finite number" : "a number " + context.range.text(),
      context.unit);
}

// YAML's spelling of what std::from_chars calls inf and nan.
std::string_view without_dot(std::string_view text) {
  constexpr std::array<std::string_view, 6> kWords = {".inf", ".Inf", ".INF",
                                                      ".nan", ".NaN", ".NAN"};
  return is_one_of(text, kWords) ? text.substr(1) : text;
}

/// Takes a sign off the front of `text`; true: it was a minus.
bool take_sign(std::string_view& text) {
  const bool is_negative = starts_with(text, "-");
  if (is_negative || starts_with(text, "+")) text.remove_prefix(1);
  return is_negative;
}

struct ParsedDouble {
  bool is_number;
  bool fits;
  double value;
};

/// Numbers are read by std::from_chars, which knows no locale: "0,5" is never a number.
ParsedDouble parse_double(std::string_view text) {
  const bool is_negative = take_sign(text);
  text = without_dot(text);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  // The sign is off by now, and from_chars would take a second one, as in "+-1".
  const bool is_number = !starts_with(text, "-") && !text.empty() && result.ptr == end &&
                         result.ec != std::errc::invalid_argument;
  return {is_number, result.ec != std::errc::result_out_of_range, is_negative ? -value : value};
}

struct ParsedWhole {
  bool is_whole;
  bool fits;
  WholeNumber number;
};

/// Decimal, or hexadecimal behind 0x.
ParsedWhole parse_whole(std::string_view text) {
  WholeNumber number{take_sign(text), 0};
  const bool is_hex = starts_with(text, "0x");
  if (is_hex) text.remove_prefix(2);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number.magnitude, is_hex ? 16 : 10);
  const bool is_whole =
      !text.empty() && result.ptr == end && result.ec != std::errc::invalid_argument;
  return {is_whole, result.ec == std::errc(), number};
}

bool is_within(const WholeNumber& number, long long lowest, unsigned long long highest) {
  // |lowest| without overflow, for lowest <= 0.
  const unsigned long long most_negative = 0 - static_cast<unsigned long long>(lowest);
  return number.magnitude <= (number.is_negative ? most_negative : highest);
}

// The limits as text: those of the type, narrowed by the field's range.
std::string whole_legal(const ValueContext& context, long long lowest, unsigned long long highest) {
  const Range& range = context.range;
  const std::string lo = range.lo > static_cast<double>(lowest)
                             ? (range.lo_open ? "(" : "[") + number_text(range.lo)
                             : '[' + std::to_string(lowest);
  const std::string hi = range.hi < static_cast<double>(highest)
                             ? number_text(range.hi) + (range.hi_open ? ")" : "]")
                             : std::to_string(highest) + ']';
  return with_unit("in " + lo + ", " + hi, context.unit);
}

std::string or_suggestion(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = closest_match(name, known);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace

void fail_type(const ValueContext& context, const ConfigNode& node, const std::string& path,
               const std::string& expected) {
  throw ConfigError(context.file, node.line, path,
                    "must be " + expected + ", but is " + node.describe());
}

void fail_range(const ValueContext& context, const ConfigNode& node, const std::string& path,
                const std::string& legal) {
  throw ConfigError(context.file, node.line, path,
                    node.describe() + " is out of range; must be " + legal);
}

bool read_bool(const ValueContext& context, const ConfigNode& node, const std::string& path) {
  // The core schema of YAML 1.2; yes, no, on and off of YAML 1.1 are text.
  constexpr std::array<std::string_view, 3> kTrue = {"true", "True", "TRUE"};
  constexpr std::array<std::string_view, 3> kFalse = {"false", "False", "FALSE"};
  if (is_plain_scalar(node) && is_one_of(node.scalar, kTrue)) return true;
  if (is_plain_scalar(node) && is_one_of(node.scalar, kFalse)) return false;
  fail_type(context, node, path, "true or false");
}

double read_double(const ValueContext& context, const ConfigNode& node, const std::string& path) {
  // The type is judged before the range: "1e400" is a number, but none that a double holds.
  const ParsedDouble parsed = parse_double(node.scalar);
  if (!is_plain_scalar(node) || !parsed.is_number) {
    fail_type(context, node, path, number_expected(context));
  }
  if (!parsed.fits || !context.range.contains(parsed.value)) {
    fail_range(context, node, path, number_expected(context));
  }
  return parsed.value;
}

const std::string& read_string(const ValueContext& context, const ConfigNode& node,
                               const std::string& path) {
  if (node.kind != Kind::kScalar) fail_type(context, node, path, "text");
  return node.scalar;
}

const ConfigNode& expect_sequence(const ValueContext& context, const ConfigNode& node,
                                  const std::string& path, int size_or_any) {
  const bool is_sized = size_or_any >= 0;
  const bool is_legal = node.kind == Kind::kSequence &&
                        (!is_sized || node.items.size() == static_cast<std::size_t>(size_or_any));
  if (!is_legal) {
    fail_type(context, node, path,
              is_sized ? "a list of " + std::to_string(size_or_any) + " items" : "a list");
  }
  return node;
}

const ConfigNode& expect_map(const ValueContext& context, const ConfigNode& node,
                             const std::string& path) {
  if (node.kind != Kind::kMap) fail_type(context, node, path, "a map (lines of key: value)");
  return node;
}

std::size_t read_choice(const ValueContext& context, const ConfigNode& node,
                        const std::string& path, const std::vector<std::string>& names) {
  const auto it = std::find(names.begin(), names.end(), node.scalar);
  if (node.kind == Kind::kScalar && it != names.end()) {
    return static_cast<std::size_t>(it - names.begin());
  }
  throw ConfigError(context.file, node.line, path,
                    "must be one of " + join(names) + ", but is " + node.describe() +
                        or_suggestion(node.scalar, names));
}

/// Digits are read exactly, as a double holds 64-bit numbers only up to 2^53.
WholeNumber read_whole_number(const ValueContext& context, const ConfigNode& node,
                              const std::string& path, long long lowest,
                              unsigned long long highest) {
  const auto [is_whole, fits, number] = parse_whole(node.scalar);
  const std::string legal = whole_legal(context, lowest, highest);
  if (!is_plain_scalar(node) || !is_whole) {
    fail_type(context, node, path, "a whole number " + legal);
  }
  const double value = static_cast<double>(number.magnitude) * (number.is_negative ? -1.0 : 1.0);
  if (!fits || !is_within(number, lowest, highest) || !context.range.contains(value)) {
    fail_range(context, node, path, "a whole number " + legal);
  }
  return number;
}

/// A field's description ends with its unit in brackets, as "speed of the motor [rad/s]".
std::string unit_of(const char* doc) {
  const std::string_view text(doc);
  const std::size_t open = text.rfind('[');
  if (!ends_with(text, "]") || open == std::string_view::npos) return "";
  return std::string(text.substr(open + 1, text.size() - open - 2));
}

std::string child_path(const std::string& parent, const std::string& key) {
  // Below an absolute ROS name such as /node, the names of parameters have slashes.
  return parent.empty() ? key : parent + (starts_with(parent, "/") ? '/' : '.') + key;
}

ConfigReader::ConfigReader(const ConfigNode& node, const std::string& file, std::string path)
    : node_(node), file_(file), path_(std::move(path)) {
  expect_map(ValueContext{file_, Range::any(), ""}, node_, path_);
}

const ConfigNode* ConfigReader::take(const char* name) {
  // Every name that is asked for is a legal key; finish() refuses the others.
  known_.emplace_back(name);
  return node_.find(name);
}

void ConfigReader::note_required(const char* name, const char* doc, const std::string& legal) {
  // Missing keys are collected, since an unknown key is the better error; see finish().
  if (node_.find(name) != nullptr) return;
  std::string problem = "missing required key";
  if (*doc != '\0') problem += std::string(" (") + doc + ')';
  if (!legal.empty()) problem += "; must be " + with_unit(legal, unit_of(doc));
  missing_.push_back({child_path(path_, name), std::move(problem)});
}

/// Unknown keys first: a key that is missing is often one that was misspelled.
void ConfigReader::finish() const {
  for (std::size_t i = 0; i < node_.keys.size(); ++i) {
    const std::string& key = node_.keys[i];
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string suggestion = or_suggestion(key, known_);
    throw ConfigError(file_, node_.key_lines[i], child_path(path_, key),
                      "unknown key (its value is " + node_.items[i].describe() + ')' +
                          (suggestion.empty() ? "." : suggestion) + " Known keys: " + join(known_));
  }
  if (!missing_.empty()) {
    throw ConfigError(file_, node_.line, missing_.front().key, missing_.front().problem);
  }
}

}  // namespace trident::config_detail
