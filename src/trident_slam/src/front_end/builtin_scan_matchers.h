// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "trident_slam/scan_matcher.h"

namespace trident {

std::unique_ptr<ScanMatcher> make_correlative_matcher(const ScanMatcherOptions& options);
std::unique_ptr<ScanMatcher> make_grid_matcher(const ScanMatcherOptions& options);
std::unique_ptr<ScanMatcher> make_hybrid_matcher(const ScanMatcherOptions& options);
std::unique_ptr<ScanMatcher> make_line_matcher(const ScanMatcherOptions& options);
std::unique_ptr<ScanMatcher> make_ndt_matcher(const ScanMatcherOptions& options);

}  // namespace trident
