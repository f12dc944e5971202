// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "relocalizer.h"

#include <Eigen/Geometry>
#include <limits>

#include "matchers/correlative_match.h"
#include "trident_base/angle.h"

namespace trident::slam {
void insert_surfels(const SurfelMap& surfels, const Eigen::Vector2d& about, double reach,
                    MaxPyramid* hits) {
  const Eigen::Vector2f center = about.cast<float>();
  const auto limit = static_cast<float>(reach);
  PointScan points;
  for (const Surfel& surfel : surfels.surfels()) {
    if (surfels.is_hidden(surfel.owner) || (surfel.mean - center).cwiseAbs().maxCoeff() > limit) {
      continue;
    }
    points.points.push_back({surfel.mean, surfel.normal});
  }
  hits->insert(SE2::identity(), points);
}

/// The whole map and all headings by branch and bound, with thinned points; the best pose is then
/// refined with all of them.
std::optional<MatchResult> relocalize_in_map(const SurfelMap& surfels, const PointScan& scan,
                                             const LineMatchOptions& line,
                                             const RelocalizationOptions& options) {
  if (surfels.empty() || scan.points.empty()) return std::nullopt;
  Eigen::AlignedBox2f box;
  for (const Surfel& surfel : surfels.surfels()) box.extend(surfel.mean);
  MaxPyramid hits(options.resolution, options.levels);
  insert_surfels(surfels, box.center().cast<double>(), std::numeric_limits<float>::max(), &hits);
  const Eigen::Vector2d center = box.center().cast<double>();
  const SearchWindow everywhere{0.5 * static_cast<double>(box.sizes().maxCoeff()), kPi};
  const auto found = match_by_branch_and_bound(
      hits, thinned_points(scan, static_cast<std::size_t>(options.max_points)),
      SE2::from_xy_yaw(center.x(), center.y(), 0.0), everywhere, options.min_response);
  if (!found) return std::nullopt;
  return match_lines(surfels, scan, found->T_ref_base, {}, line);
}

}  // namespace trident::slam
