// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/point_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace trident::slam {
namespace {

/// Beams to each side that take part in the line of a normal: at least so many, and as many more
/// as lie within the reach. Close to a wall few beams would span less than the scanner's noise.
constexpr int kMinNeighbors = 3;
constexpr int kMaxNeighbors = 24;
constexpr double kReach = 0.15;  // [m]
/// ... or farther where the scanner's noise is larger, for a line over so many standard deviations
/// of it to each side leans by no more than a few degrees.
constexpr double kReachByNoise = 12.0;
constexpr double kMaxReach = 0.6;  // [m]

/// Points that deviate less from their line have no corner among them [m].
constexpr double kStraight = 0.003;
/// Variance about the line over that of one side's, beyond which there is a corner.
constexpr double kWorseByCorner = 8.0;
/// A side is preferred only if its points spread along their line by at least so many standard
/// deviations of the scanner's noise: a line through four of them leans by 1 / (4 sqrt(4)) = 7
/// degrees then. A few beams that hit a wall close by spread less than their noise and often lie
/// on a line along the beam by chance, which would be a wall across the true one.
constexpr double kMinSpreadByNoise = 4.0;
/// Where both sides together form no line, so that the alternative is no normal at all, a little
/// less suffices (a side of the full reach spreads by kReachByNoise / sqrt(12) = 3.5), if the
/// points spread as far as this across the beam, too, where ranges put no noise.
constexpr double kMinSpreadWithoutLine = 2.5;
constexpr double kMinSpreadAcrossBeam = 1.0;

/// Neighbouring beams hit one surface if the gap between their ends is at most this [m]. A wall
/// seen at 10 degrees of grazing angle stays in one piece.
double largest_gap(double range, double angle_increment) {
  return 0.05 + 6.0 * range * std::abs(angle_increment);
}

/// Standard deviation of the ranges [m], by the median of how far each is from the middle of those
/// next to it: of beams on one surface that is noise, as long as the surface is nearly straight.
double range_noise(const std::vector<double>& ranges, double angle_increment) {
  std::vector<double> bends;
  bends.reserve(ranges.size());
  for (std::size_t i = 1; i + 1 < ranges.size(); ++i) {
    const double gap = largest_gap(ranges[i], angle_increment);
    if (std::abs(ranges[i] - ranges[i - 1]) > gap || std::abs(ranges[i + 1] - ranges[i]) > gap)
      continue;
    bends.push_back(std::abs(ranges[i - 1] - 2.0 * ranges[i] + ranges[i + 1]));
  }
  constexpr std::size_t kMinBends = 20;  // of which a median says something
  if (bends.size() < kMinBends) return 0.0;
  const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
  std::nth_element(bends.begin(), middle, bends.end());
  return *middle / (0.6745 * std::sqrt(6.0));  // of a normal distribution, and of three ranges
}

/// Sums over points.
struct LineSums {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Eigen::Vector2f& p) {
    const auto px = static_cast<double>(p.x());
    const auto py = static_cast<double>(p.y());
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
    yy += py * py;
  }
  LineSums operator-(const LineSums& other) const {
    return {x - other.x, y - other.y, xx - other.xx, xy - other.xy, yy - other.yy};
  }
};

/// How neighbouring points lie about their mean: covariance [m^2], and the variances across the
/// line that they lie on best and along it.
struct Scatter {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  double across = std::numeric_limits<double>::infinity();  ///< infinite: too few points
  double along = 0.0;

  Scatter(const LineSums& s, int n) {
    if (n < 3) return;
    const double share = 1.0 / n;
    xx = share * (s.xx - share * s.x * s.x);
    xy = share * (s.xy - share * s.x * s.y);
    yy = share * (s.yy - share * s.y * s.y);
    const double half = 0.5 * (xx - yy);
    const double root = std::sqrt(half * half + xy * xy);
    across = std::max(0.5 * (xx + yy) - root, 0.0);
    along = 0.5 * (xx + yy) + root;
  }

  /// Variance perpendicular to a beam [m^2], where ranges put no noise.
  double across_beam(const Eigen::Vector2f& beam) const {
    const Eigen::Vector2d u = beam.cast<double>().normalized();
    return yy * u.x() * u.x() - 2.0 * xy * u.x() * u.y() + xx * u.y() * u.y();
  }
};

/// The normal of the points' line, or zero if they do not lie on one. Points err along their beam
/// alone, so that is what is regressed on the direction across: a total least-squares line leans
/// towards the beams, walls of a corridor open like a funnel, and the robot slides along it. Where
/// the beam grazes the surface the regression knows too little, and where both differ by more than
/// that effect can be it is no line.
Eigen::Vector2f line_normal(const Scatter& s, const Eigen::Vector2f& beam) {
  constexpr double kThickest = 0.06;  // [m], standard deviation across the line
  if (s.across > kThickest * kThickest || s.across > 0.1 * s.along) return Eigen::Vector2f::Zero();
  // Eigenvector of the smaller eigenvalue, from the row of the matrix that does not cancel.
  const Eigen::Vector2d plain = (s.xx > s.yy ? Eigen::Vector2d(-s.xy, s.along - s.yy)
                                             : Eigen::Vector2d(s.along - s.xx, -s.xy))
                                    .normalized();
  constexpr double kGrazing = 0.3;   // sine
  constexpr double kMaxLean = 0.05;  // [rad]
  const Eigen::Vector2d u = beam.cast<double>().normalized();
  if (std::abs(plain.dot(u)) < kGrazing) return plain.cast<float>();
  const Eigen::Vector2d normal =
      Eigen::Vector2d(s.yy * u.x() - s.xy * u.y(), s.xx * u.y() - s.xy * u.x()).normalized();
  return (std::abs(normal.dot(plain)) < std::cos(kMaxLean) ? plain : normal).cast<float>();
}

/// Sets normals from the points about each point that hit the same surface.
class Normals {
 public:
  explicit Normals(PointScan* scan) : scan_(*scan), sums_(scan->points.size() + 1) {
    for (std::size_t i = 0; i < scan_.points.size(); ++i) {
      sums_[i + 1] = sums_[i];
      sums_[i + 1].add(scan_.points[i].p - scan_.origin);
    }
  }

  void set(const std::vector<double>& ranges, double angle_increment) {
    const double noise = range_noise(ranges, angle_increment);
    const double reach = std::clamp(kReachByNoise * noise, kReach, kMaxReach);
    noise_variance_ = noise * noise;
    squared_reach_ = static_cast<float>(reach * reach);
    find_surfaces(ranges, angle_increment);
    const int size = static_cast<int>(scan_.points.size());
    for (int i = 0; i < size; ++i) {
      SurfacePoint& point = scan_.points[i];
      int begin = i;
      while (begin > first_[i] && is_neighbor(i, begin - 1)) --begin;
      int end = i + 1;
      while (end < end_[i] && is_neighbor(i, end)) ++end;
      point.normal = normal_at(i, begin, end);
      if (point.normal.dot(scan_.origin - point.p) < 0.0F) point.normal = -point.normal;
    }
  }

 private:
  /// What a surface that point i is on may reach to: points first_[i] to end_[i] - 1.
  void find_surfaces(const std::vector<double>& ranges, double angle_increment) {
    const int size = static_cast<int>(scan_.points.size());
    first_.resize(size);
    end_.resize(size);
    std::vector<double> gaps(size, 0.0);  // before each point
    for (int i = 0; i < size; ++i) {
      if (i > 0) gaps[i] = static_cast<double>((scan_.points[i].p - scan_.points[i - 1].p).norm());
      const bool is_on = i > 0 && gaps[i] <= largest_gap(ranges[i], angle_increment);
      first_[i] = is_on ? first_[i - 1] : i;
    }
    for (int i = size - 1; i >= 0; --i) {
      const bool continues = i + 1 < size && gaps[i + 1] <= largest_gap(ranges[i], angle_increment);
      end_[i] = continues ? end_[i + 1] : i + 1;
    }
  }

  /// From the points begin to end - 1 about point i; by a corner from those on one side of it
  /// alone: a line about the corner leans, and what leans slides along the wall when scans are
  /// matched. M. Kuwahara et al., "Processing of RI-angiocardiographic images", 1976, for the
  /// choice. A side that spreads little compared with the scanner's noise does not count: see
  /// kMinSpreadByNoise.
  Eigen::Vector2f normal_at(int i, int begin, int end) const {
    const Eigen::Vector2f beam = scan_.points[i].p - scan_.origin;
    const Scatter both = scatter(begin, end);
    if (both.across < kStraight * kStraight) return line_normal(both, beam);
    const Scatter before = scatter(begin, i + 1);
    const Scatter after = scatter(i, end);
    const Scatter& side = before.across < after.across ? before : after;
    if (kWorseByCorner * side.across >= both.across) return line_normal(both, beam);
    if (is_wide(side.along, kMinSpreadByNoise)) return line_normal(side, beam);
    const Eigen::Vector2f normal = line_normal(both, beam);
    const bool is_side = normal.isZero(0.0F) && is_wide(side.along, kMinSpreadWithoutLine) &&
                         is_wide(side.across_beam(beam), kMinSpreadAcrossBeam);
    return is_side ? line_normal(side, beam) : normal;
  }

  /// Whether a variance [m^2] is that of points that spread by at least `factor` standard
  /// deviations of the noise.
  bool is_wide(double variance, double factor) const {
    return variance >= factor * factor * noise_variance_;
  }

  Scatter scatter(int begin, int end) const { return {sums_[end] - sums_[begin], end - begin}; }

  bool is_neighbor(int i, int j) const {
    const int apart = std::abs(i - j);
    if (apart > kMaxNeighbors) return false;
    return apart <= kMinNeighbors ||
           (scan_.points[j].p - scan_.points[i].p).squaredNorm() <= squared_reach_;
  }

  PointScan& scan_;
  std::vector<LineSums> sums_;  ///< over the points before each one, about the laser
  std::vector<int> first_;
  std::vector<int> end_;
  double noise_variance_ = 0.0;  ///< of the ranges [m^2]
  float squared_reach_ = 0.0F;   ///< of the neighbors that take part in a line [m^2]
};

/// The directions of a scan's beams one after the other: cosine and sine.
class Directions {
 public:
  Directions(double angle, double increment)
      : angle_(angle),
        increment_(increment),
        direction_(unit_at(angle)),
        turn_(unit_at(increment)) {}

  const Eigen::Vector2d& value() const { return direction_; }
  void next() {
    constexpr int kPeriod = 16;  // angles are computed again: errors stay at a few 1e-16
    if (++beam_ % kPeriod == 0) {
      direction_ = unit_at(angle_ + beam_ * increment_);
    } else {
      direction_ = {turn_.x() * direction_.x() - turn_.y() * direction_.y(),
                    turn_.y() * direction_.x() + turn_.x() * direction_.y()};
    }
  }

 private:
  static Eigen::Vector2d unit_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

  double angle_;
  double increment_;
  int beam_ = 0;
  Eigen::Vector2d direction_;
  Eigen::Vector2d turn_;
};

}  // namespace

PointScan make_point_scan(const LaserScan& scan, const PointScanOptions& options,
                          const Eigen::Vector3d& twist) {
  PointScan result;
  result.origin = scan.T_base_laser.p.cast<float>();
  const double nearest = std::max(options.min_range, scan.range_min);
  const double farthest = std::min(options.max_range, scan.range_max);
  const bool is_rolling = scan.time_increment != 0.0 && !twist.isZero(0.0);
  std::vector<double> ranges;
  ranges.reserve(scan.size());
  result.points.reserve(scan.size());
  Directions directions(scan.T_base_laser.angle + scan.angle_min, scan.angle_increment);
  for (std::size_t beam = 0; beam < scan.size(); ++beam, directions.next()) {
    const auto range = static_cast<double>(scan.ranges[beam]);
    if (!(range > 0.0 && range >= nearest && range <= farthest)) continue;  // NaN, too
    Eigen::Vector2d p = scan.T_base_laser.p + range * directions.value();
    if (is_rolling) p = SE2::exp(twist * (scan.time_increment * static_cast<double>(beam))) * p;
    ranges.push_back(range);
    result.points.push_back({p.cast<float>(), Eigen::Vector2f::Zero()});
  }
  Normals(&result).set(ranges, scan.angle_increment);
  return result;
}

}  // namespace trident::slam
