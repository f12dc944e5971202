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

// Variables in the order of elimination that approximate minimum degree finds.
std::vector<int> minimum_degree_order(int size, const Pairs& pairs) {
  if (size == 0) return {};  // AMD refuses it
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

BlockSymbolic::Columns BlockSymbolic::lower_columns(const Pairs& pairs,
                                                    const std::vector<int>& position) {
  const std::size_t size = position.size();
  Columns below{std::vector<int>(size + 1, 0), std::vector<int>(pairs.size())};
  for (const auto& [i, j] : pairs) ++below.begin[std::min(position[i], position[j]) + 1];
  std::partial_sum(below.begin.begin(), below.begin.end(), below.begin.begin());
  std::vector<int> next(below.begin.begin(), below.begin.end() - 1);
  for (const auto& [i, j] : pairs) {
    const auto [first, last] = std::minmax(position[i], position[j]);
    below.rows[next[first]++] = last;
  }
  return below;
}

// For each row the columns left of its diagonal, from the first to the last.
BlockSymbolic::Columns BlockSymbolic::transposed(const Columns& below) {
  const int size = static_cast<int>(below.begin.size()) - 1;
  Columns left_of{std::vector<int>(size + 1, 0), std::vector<int>(below.rows.size())};
  for (const int row : below.rows) ++left_of.begin[row + 1];
  std::partial_sum(left_of.begin.begin(), left_of.begin.end(), left_of.begin.begin());
  std::vector<int> next(left_of.begin.begin(), left_of.begin.end() - 1);
  for (int column = 0; column < size; ++column) {
    for (int k = below.begin[column]; k < below.begin[column + 1]; ++k) {
      left_of.rows[next[below.rows[k]]++] = column;
    }
  }
  return left_of;
}

// Liu 1990: -1 for roots.
std::vector<int> BlockSymbolic::elimination_tree(const Columns& left_of) {
  const int size = static_cast<int>(left_of.begin.size()) - 1;
  std::vector<int> parent(size, -1);
  std::vector<int> ancestor(size, -1);
  for (int row = 0; row < size; ++row) {
    for (int k = left_of.begin[row]; k < left_of.begin[row + 1]; ++k) {
      int node = left_of.rows[k];
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

// Blocks of each column of the factor, the diagonal included: a row of the factor is the part of
// the tree between the columns left of its diagonal and the row itself.
std::vector<int> BlockSymbolic::column_counts(const Columns& left_of,
                                              const std::vector<int>& parent) {
  const int size = static_cast<int>(parent.size());
  std::vector<int> mark(size, -1);
  std::vector<int> counts(size, 1);
  for (int row = 0; row < size; ++row) {
    mark[row] = row;
    for (int k = left_of.begin[row]; k < left_of.begin[row + 1]; ++k) {
      for (int node = left_of.rows[k]; mark[node] != row; node = parent[node]) {
        mark[node] = row;
        ++counts[node];
      }
    }
  }
  return counts;
}

BlockSymbolic::BlockSymbolic(int size, const Pairs& pairs) {
  const std::vector<int> order = minimum_degree_order(size, pairs);
  const Columns unsorted = transposed(lower_columns(pairs, inverse_of(order)));
  const std::vector<int> tree = elimination_tree(unsorted);
  const std::vector<int> counts = column_counts(unsorted, tree);
  const std::vector<int> sorted = postorder(tree);  // the factor is the same, in another order
  const std::vector<int> place = inverse_of(sorted);
  std::vector<int> parent(size);
  std::vector<int> sorted_counts(size);
  position_.resize(size);
  for (int k = 0; k < size; ++k) {
    const int above = tree[sorted[k]];
    parent[k] = above == -1 ? -1 : place[above];
    sorted_counts[k] = counts[sorted[k]];
    position_[order[sorted[k]]] = k;
  }
  add_supernodes(sorted_counts, parent);
  fill_rows(lower_columns(pairs, position_));
  add_entries(pairs);
}

namespace {

// Successive columns that are stored together.
struct ColumnGroup {
  int first, columns, rows;
  double zeros;  // stored as if they were not
};

std::vector<int> child_counts(const std::vector<int>& parent) {
  std::vector<int> children(parent.size(), 0);
  for (const int p : parent) {
    if (p != -1) ++children[p];
  }
  return children;
}

// Chains of the tree in which each column has the rows of the next one, and itself.
std::vector<ColumnGroup> fundamental_groups(const std::vector<int>& counts,
                                            const std::vector<int>& parent) {
  const std::vector<int> children = child_counts(parent);
  std::vector<ColumnGroup> groups;
  for (int column = 0; column < static_cast<int>(parent.size()); ++column) {
    const bool extends_last = column > 0 && parent[column - 1] == column && children[column] == 1 &&
                              counts[column - 1] == counts[column] + 1;
    if (extends_last) {
      ++groups.back().columns;
    } else {
      groups.push_back({column, 1, counts[column], 0.0});
    }
  }
  return groups;
}

// False: it is not worth it, and nothing has changed.
bool merge_if_worthwhile(const ColumnGroup& group, ColumnGroup& above) {
  const int columns = group.columns + above.columns;
  const double total = trapezoid(columns, group.columns + above.rows);
  const double zeros = group.zeros + above.zeros + total - trapezoid(group.columns, group.rows) -
                       trapezoid(above.columns, above.rows);
  if (!is_merge_worthwhile(columns, zeros, total)) return false;
  above = {group.first, columns, group.columns + above.rows, zeros};
  return true;
}

// From the last to the first: each is merged into its parent where that follows it at once. The
// first one of the columns comes last.
std::vector<ColumnGroup> merged_groups(const std::vector<ColumnGroup>& groups,
                                       const std::vector<int>& parent) {
  std::vector<ColumnGroup> merged;  // a stack, of which the last one may still grow
  for (auto it = groups.rbegin(); it != groups.rend(); ++it) {
    const int above = parent[it->first + it->columns - 1];
    const bool is_below_last =
        !merged.empty() && above != -1 && above < merged.back().first + merged.back().columns;
    if (is_below_last && merge_if_worthwhile(*it, merged.back())) continue;
    merged.push_back(*it);
  }
  return merged;
}

}  // namespace

void BlockSymbolic::add_supernodes(const std::vector<int>& counts, const std::vector<int>& parent) {
  const std::vector<ColumnGroup> groups = merged_groups(fundamental_groups(counts, parent), parent);
  supernode_of_.resize(parent.size());
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
  const int size = static_cast<int>(supernode_of_.size());
  std::vector<int> mark(size, -1);
  std::vector<int> place(size, -1);
  std::vector<int> behind;  // the own columns
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    Supernode& node = supernodes_[s];
    const int end = node.first + node.columns;
    behind.clear();
    const auto take = [&](int row) {
      if (row < end || mark[row] == static_cast<int>(s)) return;
      mark[row] = static_cast<int>(s);
      behind.push_back(row);
    };
    for (int k = below.begin[node.first]; k < below.begin[end]; ++k) take(below.rows[k]);
    for (const int child : node.children) {
      for (const int row : supernodes_[child].rows) take(row);
    }
    std::sort(behind.begin(), behind.end());
    if (!behind.empty()) {
      node.parent = supernode_of_[behind.front()];
      supernodes_[node.parent].children.push_back(static_cast<int>(s));
    }
    node.rows.resize(node.columns + behind.size());
    std::iota(node.rows.begin(), node.rows.begin() + node.columns, node.first);
    std::copy(behind.begin(), behind.end(), node.rows.begin() + node.columns);
    for (std::size_t k = 0; k < node.rows.size(); ++k) place[node.rows[k]] = static_cast<int>(k);
    for (const int child : node.children) {
      Supernode& below_it = supernodes_[child];
      below_it.place_in_parent.reserve(below_it.rows.size() - below_it.columns);
      for (std::size_t k = below_it.columns; k < below_it.rows.size(); ++k) {
        below_it.place_in_parent.push_back(place[below_it.rows[k]]);
      }
    }
  }
}

void BlockSymbolic::add_entries(const Pairs& pairs) {
  entry_begin_.assign(supernodes_.size() + 1, 0);
  const auto column_of = [&](const std::pair<int, int>& pair) {
    return std::min(position_[pair.first], position_[pair.second]);
  };
  for (const int s : supernode_of_) ++entry_begin_[s + 1];
  for (const auto& pair : pairs) ++entry_begin_[supernode_of_[column_of(pair)] + 1];
  std::partial_sum(entry_begin_.begin(), entry_begin_.end(), entry_begin_.begin());
  std::vector<std::size_t> next(entry_begin_.begin(), entry_begin_.end() - 1);
  entries_.resize(entry_begin_.back());
  const auto add = [&](int pair, int row, int column, bool is_transposed) {
    const int s = supernode_of_[column];
    const std::vector<int>& rows = supernodes_[s].rows;
    const auto place = std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
    entries_[next[s]++] = {pair, static_cast<int>(place), column - supernodes_[s].first,
                           is_transposed};
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
