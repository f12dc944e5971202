// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/path_shortcuts.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace trident::nav {
namespace {

/// Parts begin this far apart, and are not shorter [cells].
constexpr double kStride = 5.0;

/// One pass over a path.
class Pass {
 public:
  Pass(const TravelPath& path, const CurveChecker& checker, const ShortcutOptions& options)
      : path_(path), checker_(checker), options_(options) {
    double length = 0.0, cost = 0.0;
    length_.push_back(length);
    cost_.push_back(cost);
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      const Pose2& a = path.points[i - 1].pose;
      const Pose2& b = path.points[i].pose;
      length_.push_back(length += distance(a.x, a.y, b.x, b.y));
      cost_.push_back(cost += checker.cost(a, path.points[i]));
    }
  }

  /// The first part begins `lead` [cells] behind the start.
  TravelPath run(double lead, int& tries, const CancelFlag& cancel) {
    result_.points.assign(1, path_.points.front());
    std::size_t at = 0;
    copy_until(at, lead);
    while (at + 1 < path_.points.size()) {
      const bool may_try = tries > 0 && !cancel.load(std::memory_order_relaxed);
      if (!may_try || !jump(at, tries)) copy_until(at, length_[at] + kStride);
    }
    return std::move(result_);
  }

 private:
  // Copies points up to a length of the path, at least one if there is one: a path that ends where
  // it begins has none.
  void copy_until(std::size_t& at, double length) {
    if (length <= 0.0 || at + 1 >= path_.points.size()) return;
    do {
      result_.points.push_back(path_.points[++at]);
    } while (at + 1 < path_.points.size() && length_[at] < length);
  }

  // Tries curves to points ahead, the farthest first.
  bool jump(std::size_t& at, int& tries) {
    const double rest = std::min(options_.longest, length_.back() - length_[at]);
    for (double reach = rest; reach >= kStride; reach /= 2.0) {
      const auto found = std::lower_bound(length_.begin(), length_.end(), length_[at] + reach);
      const auto to =
          std::min(static_cast<std::size_t>(found - length_.begin()), path_.points.size() - 1);
      if (--tries < 0) return false;
      if (!replace(at, to)) continue;
      at = to;
      return true;
    }
    return false;
  }

  bool replace(std::size_t from, std::size_t to) {
    const Pose2& start = result_.points.back().pose;
    const MotionCurve curve =
        motion_curve(options_.model, start, path_.points[to].pose, options_.radius);
    if (curve.length() > 1.5 * (length_[to] - length_[from])) return false;
    const double bound = cost_[to] - cost_[from] - options_.min_gain - 1e-6;
    if (checker_.cost(curve, start, kLethalCost) > bound) return false;
    if (!checker_.is_free(curve, start)) return false;
    checker_.append(curve, result_);
    result_.points.back().pose = path_.points[to].pose;
    return true;
  }

  const TravelPath& path_;
  const CurveChecker& checker_;
  const ShortcutOptions& options_;
  std::vector<double> length_, cost_;
  TravelPath result_;
};

}  // namespace

TravelPath with_shortcuts(const TravelPath& path, const CurveChecker& checker,
                          const ShortcutOptions& options, const CancelFlag& cancel) {
  TravelPath best = path;
  int tries = options.max_tries;
  for (int i = 0; i < options.passes; ++i) {
    const double lead = kStride * (i % 2) / 2.0;
    const TravelPath current = std::move(best);
    best = Pass(current, checker, options).run(lead, tries, cancel);
  }
  return best;
}

}  // namespace trident::nav
