// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

namespace trident::sim {

/// Removes every item that the predicate is true for; the others keep their order.
template <class T, class Predicate>
void drop_if(std::vector<T>& items, Predicate&& is_dropped) {
  items.erase(std::remove_if(items.begin(), items.end(), is_dropped), items.end());
}

}  // namespace trident::sim
