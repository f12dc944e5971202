// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "correlative_match.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

struct Candidate {
  int turn = 0;
  int x = 0, y = 0;  ///< offset in cells, the lowest of the candidate's block
  int score = 0;     ///< sum of bounds
};

class Search {
 public:
  Search(const MaxPyramid& reference, const std::vector<Eigen::Vector2f>& points, const SE2& guess,
         const SearchWindow& window, double min_score)
      : reference_(reference),
        reach_(static_cast<int>(std::ceil(window.linear / reference.resolution()))) {
    best_.score = static_cast<int>(min_score * 255.0 * static_cast<double>(points.size()));
    turn_points(points, guess, window);
  }

  /// Squares as large as the window are the roots; a level halves them (E. Olson, "Real-Time
  /// Correlative Scan Matching", 2009; W. Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM",
  /// 2016).
  std::optional<Candidate> run() {
    int level = 0;
    while (level + 1 < reference_.levels() && (1 << level) < reach_) ++level;
    std::vector<Candidate> roots;
    for (std::size_t turn = 0; turn < cells_.size(); ++turn) {
      for (int y = -reach_; y <= reach_ && !is_spent(); y += 1 << level) {
        for (int x = -reach_; x <= reach_; x += 1 << level) {
          roots.push_back(scored({static_cast<int>(turn), x, y, 0}, level));
        }
      }
    }
    branch(&roots, level);
    return is_found_ ? std::optional<Candidate>(best_) : std::nullopt;
  }

  double yaw_of(int turn) const { return yaws_[static_cast<std::size_t>(turn)]; }

 private:
  /// A step of heading moves the farthest point by one cell: finer ones would find the same cells,
  /// coarser ones pass over poses.
  void turn_points(const std::vector<Eigen::Vector2f>& points, const SE2& guess,
                   const SearchWindow& window) {
    float farthest = 1.0F;
    for (const Eigen::Vector2f& p : points) farthest = std::max(farthest, p.norm());
    const double step = std::max(reference_.resolution() / static_cast<double>(farthest), 0.004);
    const int turns = static_cast<int>(std::ceil(std::min(window.angular, kPi) / step));
    for (int k = -turns; k <= turns; ++k) {
      yaws_.push_back(guess.angle + k * step);
      const SE2 T = SE2::from_xy_yaw(guess.p.x(), guess.p.y(), yaws_.back());
      const Eigen::Matrix2f R = T.rotation().cast<float>();
      const Eigen::Vector2f t = T.p.cast<float>();
      std::vector<Eigen::Vector2i>& cells = cells_.emplace_back();
      cells.reserve(points.size());
      for (const Eigen::Vector2f& p : points) {
        const Eigen::Vector2f q = R * p + t;
        cells.emplace_back(reference_.cell_of(static_cast<double>(q.x())),
                           reference_.cell_of(static_cast<double>(q.y())));
      }
    }
  }

  bool is_spent() const { return lookups_ >= kMaxLookups; }

  Candidate scored(Candidate candidate, int level) {
    lookups_ += static_cast<std::int64_t>(cells_[static_cast<std::size_t>(candidate.turn)].size());
    int sum = 0;
    const GrowingGrid<std::uint8_t>& grid = reference_.level(level);
    for (const Eigen::Vector2i& cell : cells_[static_cast<std::size_t>(candidate.turn)]) {
      sum += grid.get((cell.x() + candidate.x) >> level, (cell.y() + candidate.y) >> level);
    }
    candidate.score = sum;
    return candidate;
  }

  /// Best first; ties keep their order, so that the result is the same everywhere.
  void branch(std::vector<Candidate>* candidates, int level) {
    std::stable_sort(candidates->begin(), candidates->end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    for (const Candidate& candidate : *candidates) {
      if (candidate.score <= best_.score || is_spent()) return;
      if (level == 0) {
        best_ = candidate;
        is_found_ = true;
        return;
      }
      std::vector<Candidate> children;
      const int half = 1 << (level - 1);
      for (const int dy : {0, half}) {
        for (const int dx : {0, half}) {
          if (candidate.x + dx > reach_ || candidate.y + dy > reach_) continue;
          children.push_back(
              scored({candidate.turn, candidate.x + dx, candidate.y + dy, 0}, level - 1));
        }
      }
      branch(&children, level - 1);
    }
  }

  const MaxPyramid& reference_;
  int reach_;
  std::vector<double> yaws_;
  std::vector<std::vector<Eigen::Vector2i>> cells_;  ///< of the points, by turn
  Candidate best_;
  bool is_found_ = false;
  std::int64_t lookups_ = 0;  ///< so far
};

}  // namespace

std::optional<CorrelativeMatch> match_by_branch_and_bound(
    const MaxPyramid& reference, const std::vector<Eigen::Vector2f>& points, const SE2& guess,
    const SearchWindow& window, double min_score) {
  if (points.empty()) return std::nullopt;
  Search search(reference, points, guess, window, min_score);
  const std::optional<Candidate> best = search.run();
  if (!best) return std::nullopt;
  CorrelativeMatch match;
  match.T_ref_base =
      SE2::from_xy_yaw(guess.p.x() + best->x * reference.resolution(),
                       guess.p.y() + best->y * reference.resolution(), search.yaw_of(best->turn));
  match.score = best->score / (255.0 * static_cast<double>(points.size()));
  return match;
}

std::vector<Eigen::Vector2f> thinned_points(const PointScan& scan, std::size_t max_points) {
  std::vector<Eigen::Vector2f> points;
  const std::size_t stride = scan.points.size() / max_points + 1;
  for (std::size_t i = 0; i < scan.points.size(); i += stride) points.push_back(scan.points[i].p);
  return points;
}

}  // namespace trident::slam
