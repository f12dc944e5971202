// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trident_estimation/filter/measurement.h"

namespace trident::estimation {

/// When the covariances that come with measurements count as too small.
struct TrustParams {
  /// Share of a source's measurements that are farther from the expectation than half of them
  /// should be (the median of chi-squared), above which its covariances are too small; in (0.5, 1).
  double too_far = 0.75;
  double memory = 100.0;  ///< measurements that the share is over, at least 1
  /// Measurements of a source that are gated in a row before it is let in again: not they are
  /// wrong, but the belief, which is taken to be wider, fourfold from one to the next.
  int patience = 12;

  /// Throws Error for what is out of range.
  void validate() const;
};

/// Finds covariances that are too small by the normalized innovations squared, and by how much. It
/// counts how often these are beyond their median, so that a few outliers, however far, change
/// little. Covariances that are too small make all others look wrong, too: only the source with the
/// largest share is called wrong, and its covariances are multiplied by what brings the share to
/// one half. No covariance is ever made smaller.
class Trust {
 public:
  /// What is believed of a source.
  struct Source {
    double share = 0.5;      ///< of measurements that are beyond the median of what is expected
    double inflation = 1.0;  ///< what its covariances are multiplied by; 1: believed
    int gated_in_row = 0;    ///< measurements
  };

  explicit Trust(const TrustParams& params = {}) : params_(params) {}

  /// How much a source's covariances are to be multiplied by.
  double inflation(std::size_t source) const;
  /// How much the belief is to be widened for a source's next measurement.
  double widening(std::size_t source) const;
  /// What became of a measurement of it. What was refused counts nothing.
  void note(std::size_t source, const Outcome& outcome);
  /// By number; those that nothing was noted of may be missing.
  const std::vector<Source>& sources() const { return sources_; }

 private:
  bool is_accused(const Source& source) const;

  TrustParams params_;
  std::vector<Source> sources_;
};

}  // namespace trident::estimation
