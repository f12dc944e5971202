// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trident_base/random_stream.h"
#include "trident_base/se3.h"

namespace trident::sim {

/// Standard normals, the same ones in every run.
inline Vector6d random_vector6(std::uint64_t index) {
  const RandomStream stream(1, "marine test vector");
  Vector6d result;
  for (int i = 0; i < 6; ++i) result[i] = stream.normal(index, static_cast<std::uint32_t>(i));
  return result;
}

inline Matrix6d random_matrix6(std::uint64_t index) {
  Matrix6d result;
  for (int j = 0; j < 6; ++j) result.col(j) = random_vector6(1000 + 10 * index + j);
  return result;
}

}  // namespace trident::sim
