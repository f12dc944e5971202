// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace trident {

/// Every error that bad input (a file, a field, a command) can cause. The text is complete: it
/// names the file, the line or field, the value and the legal range, so a caller only has to print
/// it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace trident
