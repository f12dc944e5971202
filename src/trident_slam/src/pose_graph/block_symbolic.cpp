// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "block_symbolic.h"

#include <suitesparse/amd.h>

#include <algorithm>
#include <numeric>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

using Pairs = std::vector<std::pair<int, int>>;
using Columns = std::vector<std::vector<int>>;

// Variables in the order of elimination that approximate minimum degree finds.
std::vector<int> minimum_degree_order(int size, const Pairs& pairs) {
  std::vector<int> begin(size + 1, 0);
  for (const auto& [i, j] : pairs) {
    ++begin[i + 1];
    ++begin[j + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int> next(begin.begin(), begin.end() - 1);
  std::vector<int> rows(begin.back() + 1);  // AMD refuses an empty one
  for (const auto& [i, j] : pairs) {
    rows[next[i]++] = j;
    rows[next[j]++] = i;
  }
  std::vector<int> order(size);
  const int status = amd_order(size, begin.data(), rows.data(), order.data(), nullptr, nullptr);
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED) throw Error("pose graph: AMD failed");
  return order;
}

// For each column, by place in the order, the rows below its diagonal.
Columns lower_columns(int size, const Pairs& pairs, const std::vector<int>& position) {
  Columns below(size);
  for (const auto& [i, j] : pairs) {
    const auto [first, last] = std::minmax(position[i], position[j]);
    below[first].push_back(last);
  }
  return below;
}

// The elimination tree (Liu 1990): -1 for roots.
std::vector<int> elimination_tree(const Columns& below) {
  const int size = static_cast<int>(below.size());
  Columns left_of(size);  // rows, with their columns
  for (int column = 0; column < size; ++column) {
    for (const int row : below[column]) left_of[row].push_back(column);
  }
  std::vector<int> parent(size, -1);
  std::vector<int> ancestor(size, -1);
  for (int row = 0; row < size; ++row) {
    for (int node : left_of[row]) {
      while (node != -1 && node != row) {
        const int next = ancestor[node];
        ancestor[node] = row;
        if (next == -1) parent[node] = row;
        node = next;
      }
    }
  }
  return parent;
}

// Children before their parents, subtrees in one piece.
std::vector<int> postorder(const std::vector<int>& parent) {
  const int size = static_cast<int>(parent.size());
  std::vector<int> first_child(size, -1);
  std::vector<int> sibling(size, -1);
  std::vector<int> stack;
  for (int node = size - 1; node >= 0; --node) {
    if (parent[node] == -1) continue;
    sibling[node] = first_child[parent[node]];
    first_child[parent[node]] = node;
  }
  std::vector<int> order;
  order.reserve(size);
  for (int root = 0; root < size; ++root) {
    if (parent[root] != -1) continue;
    stack.push_back(root);
    while (!stack.empty()) {
      const int node = stack.back();
      if (first_child[node] != -1) {
        stack.push_back(first_child[node]);
        first_child[node] = sibling[first_child[node]];
      } else {
        order.push_back(node);
        stack.pop_back();
      }
    }
  }
  return order;
}

std::vector<int> inverse_of(const std::vector<int>& order) {
  std::vector<int> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<int>(k);
  return position;
}

// Blocks of each column of the factor, the diagonal included.
std::vector<int> column_counts(const Columns& below, const std::vector<int>& parent) {
  const int size = static_cast<int>(below.size());
  Columns rows(size);
  std::vector<int> mark(size, -1);
  std::vector<int> counts(size, 1);
  for (int column = 0; column < size; ++column) {
    std::vector<int>& own = rows[column];  // what the children have left here
    mark[column] = column;
    std::vector<int> merged;
    for (const std::vector<int>* part :
         {&below[column], static_cast<const std::vector<int>*>(&own)}) {
      for (const int row : *part) {
        if (mark[row] == column) continue;
        mark[row] = column;
        merged.push_back(row);
      }
    }
    counts[column] += static_cast<int>(merged.size());
    own.clear();
    own.shrink_to_fit();
    if (parent[column] == -1) continue;
    std::vector<int>& above = rows[parent[column]];
    above.insert(above.end(), merged.begin(), merged.end());
  }
  return counts;
}

// Blocks of a trapezoid of so many columns, the first of which has so many rows.
double trapezoid(double columns, double rows) {
  return columns * rows - 0.5 * columns * (columns - 1.0);
}

// Is it worth treating two supernodes as one, with zeros stored as if they were not? The limits are
// those of CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008), in blocks.
bool is_merge_worthwhile(int columns, double zeros, double total) {
  if (columns <= 2) return true;
  const double part = zeros / total;
  if (columns <= 6) return part < 0.4;
  if (columns <= 12) return part < 0.15;
  return part < 0.05;
}

}  // namespace

BlockSymbolic::BlockSymbolic(int size, const Pairs& pairs) {
  std::vector<int> order = minimum_degree_order(size, pairs);
  const std::vector<int> tree = elimination_tree(lower_columns(size, pairs, inverse_of(order)));
  std::vector<int> sorted;
  for (const int k : postorder(tree)) sorted.push_back(order[k]);
  position_ = inverse_of(sorted);
  const Columns below = lower_columns(size, pairs, position_);
  add_supernodes(below, elimination_tree(below));
  fill_rows(below);
  add_entries(pairs);
}

void BlockSymbolic::add_supernodes(const Columns& below, const std::vector<int>& parent) {
  const int size = static_cast<int>(below.size());
  const std::vector<int> counts = column_counts(below, parent);
  std::vector<int> children(size, 0);
  for (const int p : parent) {
    if (p != -1) ++children[p];
  }
  struct Group {
    int first, columns, rows;
    double zeros;
  };
  std::vector<Group> groups;  // a stack, of which the last one may still grow
  std::vector<Group> fundamental;
  for (int column = 0; column < size; ++column) {
    const bool goes_on = column > 0 && parent[column - 1] == column && children[column] == 1 &&
                         counts[column - 1] == counts[column] + 1;
    if (goes_on) {
      ++fundamental.back().columns;
    } else {
      fundamental.push_back({column, 1, counts[column], 0.0});
    }
  }
  // From the last to the first: each is merged into its parent where that follows it at once.
  for (auto it = fundamental.rbegin(); it != fundamental.rend(); ++it) {
    const int last = it->first + it->columns - 1;
    if (!groups.empty() && parent[last] != -1 &&
        parent[last] < groups.back().first + groups.back().columns) {
      Group& above = groups.back();
      const int columns = it->columns + above.columns;
      const double total = trapezoid(columns, it->columns + above.rows);
      const double zeros = it->zeros + above.zeros + total - trapezoid(it->columns, it->rows) -
                           trapezoid(above.columns, above.rows);
      if (is_merge_worthwhile(columns, zeros, total)) {
        above = {it->first, columns, it->columns + above.rows, zeros};
        continue;
      }
    }
    groups.push_back(*it);
  }
  supernode_of_.resize(size);
  for (auto it = groups.rbegin(); it != groups.rend(); ++it) {
    const int index = static_cast<int>(supernodes_.size());
    std::fill_n(supernode_of_.begin() + it->first, it->columns, index);
    Supernode supernode;
    supernode.first = it->first;
    supernode.columns = it->columns;
    supernodes_.push_back(std::move(supernode));
  }
}

void BlockSymbolic::fill_rows(const Columns& below) {
  std::vector<int> mark(below.size(), -1);
  std::vector<int> place(below.size(), -1);
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    Supernode& node = supernodes_[s];
    const int end = node.first + node.columns;
    const auto take = [&](const std::vector<int>& rows) {
      for (const int row : rows) {
        if (row < end || mark[row] == static_cast<int>(s)) continue;
        mark[row] = static_cast<int>(s);
        node.rows.push_back(row);
      }
    };
    for (int column = node.first; column < end; ++column) take(below[column]);
    for (const int child : node.children) take(supernodes_[child].rows);
    std::sort(node.rows.begin(), node.rows.end());
    if (!node.rows.empty()) {
      node.parent = supernode_of_[node.rows.front()];
      supernodes_[node.parent].children.push_back(static_cast<int>(s));
    }
    std::vector<int> own(node.columns);
    std::iota(own.begin(), own.end(), node.first);
    node.rows.insert(node.rows.begin(), own.begin(), own.end());
    for (std::size_t k = 0; k < node.rows.size(); ++k) place[node.rows[k]] = static_cast<int>(k);
    for (const int child : node.children) {
      Supernode& below_it = supernodes_[child];
      for (std::size_t k = below_it.columns; k < below_it.rows.size(); ++k) {
        below_it.place_in_parent.push_back(place[below_it.rows[k]]);
      }
    }
  }
}

void BlockSymbolic::add_entries(const Pairs& pairs) {
  entries_.resize(supernodes_.size());
  const auto add = [&](int pair, int row, int column, bool is_transposed) {
    const int s = supernode_of_[column];
    const std::vector<int>& rows = supernodes_[s].rows;
    const auto place = std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
    entries_[s].push_back(
        {pair, static_cast<int>(place), column - supernodes_[s].first, is_transposed});
  };
  for (int variable = 0; variable < size(); ++variable) {
    add(-1 - variable, position_[variable], position_[variable], false);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int i = position_[pairs[k].first];
    const int j = position_[pairs[k].second];
    add(static_cast<int>(k), std::max(i, j), std::min(i, j), j > i);
  }
}

std::size_t BlockSymbolic::factor_blocks() const {
  double blocks = 0.0;
  for (const Supernode& node : supernodes_) {
    blocks += trapezoid(node.columns, static_cast<double>(node.rows.size()));
  }
  return static_cast<std::size_t>(blocks);
}

}  // namespace trident::slam
