// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "block_cholesky.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "dense_kernels.h"

namespace trident::slam {
namespace {

using Supernode = BlockSymbolic::Supernode;

template <int kSize>
constexpr int kStrip = kSize == 2 ? 2 : 3;

// Allocates pieces in one block of memory: always the lowest gap that fits.
class FirstFit {
 public:
  std::size_t take(std::size_t size) {
    std::size_t begin = 0;
    for (const auto& [taken, length] : taken_) {
      if (taken >= begin + size) break;
      begin = taken + length;
    }
    if (size > 0) taken_[begin] = size;
    end_ = std::max(end_, begin + size);
    return begin;
  }
  void release(std::size_t begin) { taken_.erase(begin); }
  std::size_t end() const { return end_; }

 private:
  std::map<std::size_t, std::size_t> taken_;
  std::size_t end_ = 0;
};

// Four sums, so that additions need not wait for each other.
double dot(const double* a, const double* b, std::ptrdiff_t size) {
  double sum[4] = {0.0, 0.0, 0.0, 0.0};
  std::ptrdiff_t k = 0;
  for (; k + 4 <= size; k += 4) {
    for (int lane = 0; lane < 4; ++lane) sum[lane] += a[k + lane] * b[k + lane];
  }
  for (; k < size; ++k) sum[0] += a[k] * b[k];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

void add_scaled(double* to, const double* from, double factor, std::ptrdiff_t size) {
  for (std::ptrdiff_t k = 0; k < size; ++k) to[k] += factor * from[k];
}

/// Rows of a supernode's panel in scalars: its own columns and the rows below them.
template <int kSize>
std::ptrdiff_t scalar_rows(const Supernode& node) {
  return kSize * static_cast<std::ptrdiff_t>(node.rows.size());
}

/// Rows of its update matrix, those below its columns.
template <int kSize>
std::ptrdiff_t update_rows(const Supernode& node) {
  return kSize * (static_cast<std::ptrdiff_t>(node.rows.size()) - node.columns);
}

}  // namespace

template <int kSize>
BlockCholesky<kSize>::BlockCholesky(std::shared_ptr<const BlockSymbolic> symbolic) {
  reset(std::move(symbolic));
}

// An update matrix lives from the moment when its supernode is eliminated until its parent has
// added it. In postorder the storage of few of them is enough, and FirstFit finds who can share.
template <int kSize>
void BlockCholesky<kSize>::reset(std::shared_ptr<const BlockSymbolic> symbolic) {
  symbolic_ = std::move(symbolic);
  panel_begin_.clear();
  update_begin_.clear();
  const std::vector<Supernode>& nodes = symbolic_->supernodes();
  std::size_t panels = 0;
  std::ptrdiff_t most_below = 0;
  FirstFit fit;
  for (const Supernode& node : nodes) {
    panel_begin_.push_back(panels);
    panels += padded_rows(scalar_rows<kSize>(node)) * kSize * node.columns;
    const std::ptrdiff_t below = update_rows<kSize>(node);
    most_below = std::max(most_below, below);
    update_begin_.push_back(fit.take(below == 0 ? 0 : padded_rows(below) * below));
    for (const int child : node.children) fit.release(update_begin_[child]);
  }
  panels_.resize(panels);
  updates_.resize(fit.end());
  below_.resize(most_below);
  permuted_.resize(static_cast<std::size_t>(kSize) * symbolic_->size());
}

// Copies the entries of the matrix into the panel, which is dense within the supernode's pattern.
template <int kSize>
void BlockCholesky<kSize>::assemble(std::size_t s, const BlockMatrix<kSize>& matrix) {
  const Supernode& node = symbolic_->supernodes()[s];
  const std::ptrdiff_t ld = padded_rows(scalar_rows<kSize>(node));
  double* panel = panels_.data() + panel_begin_[s];
  std::fill_n(panel, ld * kSize * node.columns, 0.0);
  using Target = Eigen::Map<Block, 0, Eigen::OuterStride<>>;
  const BlockSymbolic::Entry* end = symbolic_->entries_end(s);
  for (const BlockSymbolic::Entry* it = symbolic_->entries_begin(s); it != end; ++it) {
    const BlockSymbolic::Entry& entry = *it;
    Target target(panel + kSize * (entry.row + entry.column * ld), Eigen::OuterStride<>(ld));
    if (entry.pair < 0) {
      target = matrix.diagonal[-1 - entry.pair];
    } else if (entry.is_transposed) {
      target = matrix.pairs[entry.pair].transpose();
    } else {
      target = matrix.pairs[entry.pair];
    }
  }
}

// The extend-add of the multifrontal method (Duff and Reid 1983): the child's update matrix is
// scattered over the parent's panel and the parent's own update matrix.
template <int kSize>
void BlockCholesky<kSize>::add_child(std::size_t parent, std::size_t child) {
  const Supernode& above = symbolic_->supernodes()[parent];
  const Supernode& node = symbolic_->supernodes()[child];
  const std::ptrdiff_t ld_panel = padded_rows(scalar_rows<kSize>(above));
  const std::ptrdiff_t ld_update = padded_rows(update_rows<kSize>(above));
  const std::ptrdiff_t ld = padded_rows(update_rows<kSize>(node));
  const std::vector<int>& places = node.place_in_parent;
  double* panel = panels_.data() + panel_begin_[parent];
  double* update = update_of(parent);
  const double* from = update_of(child);
  for (std::size_t column = 0; column < places.size(); ++column) {
    const int place = places[column];
    const bool is_in_panel = place < above.columns;
    const std::ptrdiff_t stride = is_in_panel ? ld_panel : ld_update;
    // First row of the target's column, such that rows count as among the parent's rows.
    double* to = is_in_panel
                     ? panel + kSize * place * ld_panel
                     : update + kSize * ((place - above.columns) * ld_update - above.columns);
    for (int c = 0; c < kSize; ++c, to += stride, from += ld) {
      for (std::size_t row = column; row < places.size(); ++row) {
        double* target = to + kSize * places[row];
        const double* source = from + kSize * row;
        for (int r = 0; r < kSize; ++r) target[r] += source[r];
      }
    }
  }
}

// In postorder a supernode's children are complete when it is assembled. False: a pivot is not
// positive, so the matrix is not positive definite.
template <int kSize>
bool BlockCholesky<kSize>::factorize(const BlockMatrix<kSize>& matrix) {
  const std::vector<Supernode>& nodes = symbolic_->supernodes();
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const Supernode& node = nodes[s];
    const std::ptrdiff_t below = update_rows<kSize>(node);
    const std::ptrdiff_t columns = kSize * node.columns;
    const std::ptrdiff_t ld = padded_rows(scalar_rows<kSize>(node));
    assemble(s, matrix);
    if (below > 0) std::fill_n(update_of(s), padded_rows(below) * below, 0.0);
    for (const int child : node.children) add_child(s, child);
    double* panel = panels_.data() + panel_begin_[s];
    if (!factorize_panel(panel, ld, columns + below, columns, kStrip<kSize>)) return false;
    if (below > 0) {
      subtract_outer_product(update_of(s), padded_rows(below), panel + columns, ld, below, columns,
                             kStrip<kSize>);
    }
  }
  return true;
}

// The panels' diagonals hold reciprocals, so that both substitutions multiply instead of dividing.
template <int kSize>
void BlockCholesky<kSize>::forward(const Supernode& node, const double* panel, double* x) {
  const std::ptrdiff_t below = update_rows<kSize>(node);
  const std::ptrdiff_t columns = kSize * node.columns;
  const std::ptrdiff_t ld = padded_rows(columns + below);
  double* own = x + kSize * node.first;
  std::fill_n(below_.begin(), below, 0.0);
  for (std::ptrdiff_t c = 0; c < columns; ++c, panel += ld) {
    own[c] *= panel[c];
    add_scaled(own + c + 1, panel + c + 1, -own[c], columns - c - 1);
    add_scaled(below_.data(), panel + columns, own[c], below);
  }
  for (std::size_t row = node.columns; row < node.rows.size(); ++row) {
    double* target = x + kSize * node.rows[row];
    const double* source = below_.data() + kSize * (row - node.columns);
    for (int r = 0; r < kSize; ++r) target[r] -= source[r];
  }
}

template <int kSize>
void BlockCholesky<kSize>::backward(const Supernode& node, const double* panel, double* x) {
  const std::ptrdiff_t below = update_rows<kSize>(node);
  const std::ptrdiff_t columns = kSize * node.columns;
  const std::ptrdiff_t ld = padded_rows(columns + below);
  double* own = x + kSize * node.first;
  for (std::size_t row = node.columns; row < node.rows.size(); ++row) {
    std::copy_n(x + kSize * node.rows[row], kSize, below_.begin() + kSize * (row - node.columns));
  }
  for (std::ptrdiff_t c = columns - 1; c >= 0; --c) {
    const double* column = panel + c * ld;
    const double known = dot(column + c + 1, own + c + 1, columns - c - 1) +
                         dot(column + columns, below_.data(), below);
    own[c] = (own[c] - known) * column[c];
  }
}

// x = P' L^-T L^-1 P b; P is the fill-reducing order of the variables.
template <int kSize>
void BlockCholesky<kSize>::solve(Eigen::VectorXd& vector) {
  const std::vector<Supernode>& nodes = symbolic_->supernodes();
  for (int k = 0; k < symbolic_->size(); ++k) {
    std::copy_n(vector.data() + kSize * k, kSize,
                permuted_.begin() + kSize * symbolic_->position(k));
  }
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    forward(nodes[s], panels_.data() + panel_begin_[s], permuted_.data());
  }
  for (std::size_t s = nodes.size(); s-- > 0;) {
    backward(nodes[s], panels_.data() + panel_begin_[s], permuted_.data());
  }
  for (int k = 0; k < symbolic_->size(); ++k) {
    std::copy_n(permuted_.begin() + kSize * symbolic_->position(k), kSize,
                vector.data() + kSize * k);
  }
}

// L^-1 P e of a variable's columns e: the marginal covariance is the product of this with itself.
template <int kSize>
typename BlockCholesky<kSize>::Columns BlockCholesky<kSize>::half_solve(int variable) {
  Columns result = Columns::Zero(kSize * symbolic_->size(), kSize);
  const int position = symbolic_->position(variable);
  for (int c = 0; c < kSize; ++c) {
    double* x = result.data() + c * result.rows();
    x[kSize * position + c] = 1.0;
    // Only the supernodes on the path to the root are visited.
    for (int s = symbolic_->supernode_of(position); s != -1;) {
      const Supernode& node = symbolic_->supernodes()[s];
      forward(node, panels_.data() + panel_begin_[s], x);
      s = node.parent;
    }
  }
  return result;
}

template class BlockCholesky<2>;
template class BlockCholesky<3>;
template class BlockCholesky<6>;

}  // namespace trident::slam
