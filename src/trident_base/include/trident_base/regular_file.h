// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <string>

#include "trident_base/error.h"

namespace trident {

/// Throws Error for a device, which is endless. Accepts a missing file: opening it reports that.
inline void check_no_device(const std::string& path, const std::string& legal) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) return;
  if (S_ISCHR(about.st_mode) || S_ISBLK(about.st_mode)) {
    throw Error(path + ": is a device, legal: " + legal);
  }
}

}  // namespace trident
