// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trident::sim {

/// Eight bits a channel, row by row from the top.
struct PictureFile {
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> rgba;
};

/// Reads a PNG or a JPEG, recognized by how it begins, not by its name. Throws Error that names the
/// file and why it cannot be read: no such file, damaged, or more than 16384 pixels a side.
PictureFile read_picture(const std::string& file);

}  // namespace trident::sim
