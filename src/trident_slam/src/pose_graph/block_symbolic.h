// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace trident::slam {

/// What the sparsity of a symmetric matrix of equal square blocks says about its Cholesky factor:
/// the order of elimination and the supernodes, groups of consecutive columns with the same rows
/// below. Blocks are ordered, not scalars, so one structure serves blocks of any size.
class BlockSymbolic {
 public:
  /// Columns [first, first + columns) in the order of elimination, and the rows of their part of
  /// the factor: those columns themselves and what lies below, sorted.
  struct Supernode {
    int first = 0;
    int columns = 0;
    int parent = -1;  ///< supernode that takes the update, -1: a root
    std::vector<int> rows;
    /// For each row behind the own columns, its place among the parent's rows.
    std::vector<int> place_in_parent;
    std::vector<int> children;
  };
  /// Where a block of the matrix belongs in the factor.
  struct Entry {
    int pair = 0;  ///< index into the pairs; of a diagonal block: -1 - variable
    int row = 0;   ///< among the supernode's rows
    int column = 0;
    bool is_transposed = false;  ///< the factor takes the block (second, first) of the pair
  };

  /// `pairs`: blocks (i, j), i != j, each unordered pair at most once; 0 <= i, j < size.
  BlockSymbolic(int size, const std::vector<std::pair<int, int>>& pairs);

  int size() const { return static_cast<int>(position_.size()); }
  /// Place of a variable in the order of elimination.
  int position(int variable) const { return position_[variable]; }
  const std::vector<Supernode>& supernodes() const { return supernodes_; }
  int supernode_of(int position) const { return supernode_of_[position]; }
  /// Those of a supernode: [begin, end).
  const Entry* entries_begin(std::size_t s) const { return entries_.data() + entry_begin_[s]; }
  const Entry* entries_end(std::size_t s) const { return entries_.data() + entry_begin_[s + 1]; }
  /// Blocks of the factor, and multiplications of blocks to compute it.
  std::size_t factor_blocks() const;

 private:
  /// For each column, by place in the order, the rows below its diagonal, all in one piece.
  struct Columns {
    std::vector<int> begin;  ///< of each column's part, and behind the last one
    std::vector<int> rows;
  };

  static Columns lower_columns(const std::vector<std::pair<int, int>>& pairs,
                               const std::vector<int>& position);
  static Columns transposed(const Columns& below);
  static std::vector<int> elimination_tree(const Columns& left_of);
  static std::vector<int> column_counts(const Columns& left_of, const std::vector<int>& parent);
  void add_supernodes(const std::vector<int>& counts, const std::vector<int>& parent);
  void fill_rows(const Columns& below);
  void add_entries(const std::vector<std::pair<int, int>>& pairs);

  std::vector<int> position_;
  std::vector<Supernode> supernodes_;
  std::vector<int> supernode_of_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> entry_begin_;
};

}  // namespace trident::slam
