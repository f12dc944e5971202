// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_sim/model_spec.h"

namespace trident::sim {

/// A grey picture whose brightness is height. Rows from the top of the picture down.
struct HeightImage {
  int columns = 0, rows = 0;
  std::vector<float> brightness;  ///< row by row, 0 (black) to 1 (white)
};

/// Reads a PNG (8 or 16 bit; colours are turned grey) or a PGM (P2 or P5, up to 65535). The first
/// bytes decide what the file is. Throws Error with the file's name.
HeightImage read_height_image(const std::string& file);

/// The same, with heights [m] instead of brightness: black is at 0, the brightest pixel at size.z.
HeightImage read_heights(const HeightmapShape& shape);

}  // namespace trident::sim
