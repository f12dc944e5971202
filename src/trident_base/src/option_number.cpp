// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/option_number.h"

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {

double option_number(const std::string& option, const std::string& text, double lo, double hi) {
  const std::optional<double> value = number_from_text(text);
  if (value && *value >= lo && *value <= hi) return *value;
  throw Error("option " + option + " is '" + text + "', must be a number in [" +
              std::to_string(lo) + ", " + std::to_string(hi) + "]");
}

}  // namespace trident
