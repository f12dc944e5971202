// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace trident {

/// How often this process has taken memory by malloc, calloc or realloc, operator new and libraries
/// included. A program that calls this has a malloc that counts, so a test of it stands alone.
std::size_t allocation_count();

template <class Work>
std::size_t allocations_of(const Work& work) {
  const std::size_t before = allocation_count();
  work();
  return allocation_count() - before;
}

}  // namespace trident
