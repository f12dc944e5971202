// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lidar_pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>

#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr double kTurn = 2.0 * kPi;

std::vector<double> read_numbers(const PluginParams& params, const char* key) {
  const std::string text = params.text(key, "");
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::istringstream number(word);
    double value = 0.0;
    if (!(number >> value) || !number.eof() || !std::isfinite(value)) {
      params.refuse(key, text, "finite numbers");
    }
    numbers.push_back(value);
  }
  return numbers;
}

/// Of each ring [rad]: those that are given, or as many as the sensor has, evenly spread.
std::vector<double> read_elevations(const BeamFan& fan, const PluginParams& params) {
  std::vector<double> elevations = read_numbers(params, "elevations");
  if (elevations.empty()) {
    for (int i = 0; i < fan.beams; ++i) elevations.push_back(fan.angle_rad(i));
    return elevations;
  }
  // Ring 0 is the lowest beam, as in Velodyne's ROS driver.
  const bool rises = std::is_sorted(elevations.begin(), elevations.end());
  const bool fits = static_cast<int>(elevations.size()) == fan.beams;
  if (!rises || !fits || elevations.front() < -kPi / 2 || elevations.back() > kPi / 2) {
    params.refuse("elevations", params.text("elevations", ""),
                  "rising numbers in [-pi/2, pi/2], one for each of the " +
                      std::to_string(fan.beams) + " vertical <samples>");
  }
  return elevations;
}

/// Ring that is cast first, second, ...
std::vector<std::size_t> read_firing_order(std::size_t rings, const PluginParams& params) {
  std::vector<std::size_t> order(rings);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<double> given = read_numbers(params, "firingOrder");
  if (given.empty()) return order;
  const bool is_permutation =
      given.size() == rings &&
      std::is_permutation(given.begin(), given.end(), order.begin(),
                          [](double a, std::size_t b) { return a == static_cast<double>(b); });
  if (!is_permutation) {
    params.refuse("firingOrder", params.text("firingOrder", ""),
                  "each ring once, 0 to " + std::to_string(rings - 1));
  }
  std::transform(given.begin(), given.end(), order.begin(),
                 [](double ring) { return static_cast<std::size_t>(ring); });
  return order;
}

/// Rings of beams that turn about z together.
class RingPattern : public LidarPattern {
 public:
  RingPattern(const BeamFan& fan, const std::vector<double>& elevations, double column_period_s,
              std::vector<Beam> beams)
      : LidarPattern(static_cast<std::size_t>(fan.beams), column_period_s, std::move(beams),
                     Neighbors::kAcrossColumns) {
    const double spin = column_period_s > 0.0 ? fan.increment_rad() / column_period_s : 0.0;
    for (std::size_t i = 0; i < elevations.size(); ++i) {
      // The head turns while a column is fired, so a later beam is further in azimuth.
      const double azimuth = spin * this->beams()[i].time_s, level = std::cos(elevations[i]);
      directions_.emplace_back(level * std::cos(azimuth), level * std::sin(azimuth),
                               std::sin(elevations[i]));
    }
    for (int i = 0; i < fan.beams; ++i) {
      headings_.emplace_back(std::cos(fan.angle_rad(i)), std::sin(fan.angle_rad(i)));
    }
  }

  void aim(std::uint64_t, std::size_t column, Eigen::Vector3d* directions) const override {
    const double c = headings_[column].x(), s = headings_[column].y();
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const Eigen::Vector3d& d = directions_[i];
      directions[i] = {c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z()};
    }
  }

 private:
  std::vector<Eigen::Vector3d> directions_;  ///< by ring, of a column at azimuth zero
  std::vector<Eigen::Vector2d> headings_;    ///< cosine and sine of the azimuth, by column
};

/// Two wedge prisms in a row, each of which turns and bends the beam by the same small angle: what
/// Livox' Mid sensors do (optics: Brazeal, Wilkinson, Hochmair, "A rigorous observation model for
/// the Risley prism-based Livox Mid-40 lidar sensor", Sensors 21(14):4722, 2021; equal wedges at
/// 7294 and -4664 rpm: the "risley" scanner of HELIOS++, 3dgeo-heidelberg/helios), to first order:
/// the bends add as vectors in the plane x = 1,
///   (y, z) = tan(half cone) / 2 (e^(i w1 t) + e^(i w2 t)).
class RosettePattern : public LidarPattern {
 public:
  struct Prisms {
    double cone_half_rad, rate1_rad_s, rate2_rad_s;
  };
  RosettePattern(std::size_t points, double scan_period_s, const Prisms& prisms, bool is_rolling)
      : LidarPattern(points / kGroup, is_rolling ? column_period_s(scan_period_s, points) : 0.0,
                     group(is_rolling ? scan_period_s / static_cast<double>(points) : 0.0),
                     Neighbors::kWithinColumn),
        prisms_(prisms),
        scan_period_s_(scan_period_s) {
    for (std::size_t i = 0; i < points; ++i) {
      const double t = scan_period_s * static_cast<double>(i) / static_cast<double>(points);
      bends_.push_back({phasor(prisms.rate1_rad_s, t), phasor(prisms.rate2_rad_s, t)});
    }
  }
  static constexpr std::size_t kGroup = 8;  ///< beams of a column

  void aim(std::uint64_t scan, std::size_t column, Eigen::Vector3d* directions) const override {
    const double begin_s = static_cast<double>(scan) * scan_period_s_;
    const double reach = 0.5 * std::tan(prisms_.cone_half_rad);
    // As complex numbers: the phasor at the scan's beginning times the one within the scan, which
    // saves a sine and a cosine for every beam.
    const Eigen::Vector2d turn1 = reach * phasor(prisms_.rate1_rad_s, begin_s);
    const Eigen::Vector2d turn2 = reach * phasor(prisms_.rate2_rad_s, begin_s);
    for (std::size_t i = 0; i < kGroup; ++i) {
      const Bends& bends = bends_[column * kGroup + i];
      const Eigen::Vector2d bend = product(turn1, bends.first) + product(turn2, bends.second);
      directions[i] = Eigen::Vector3d(1.0, bend.x(), bend.y()).normalized();
    }
  }

 private:
  static double column_period_s(double scan_period_s, std::size_t points) {
    const std::size_t columns = points / kGroup;
    return scan_period_s / static_cast<double>(columns);
  }
  struct Bends {
    Eigen::Vector2d first, second;
  };
  static std::vector<Beam> group(double beam_period_s) {
    std::vector<Beam> beams(kGroup);
    for (std::size_t i = 0; i < kGroup; ++i)
      beams[i].time_s = static_cast<double>(i) * beam_period_s;
    return beams;
  }
  static Eigen::Vector2d phasor(double rate_rad_s, double t) {
    const double phase = std::fmod(rate_rad_s * t, kTurn);
    return {std::cos(phase), std::sin(phase)};
  }
  static Eigen::Vector2d product(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
  }

  Prisms prisms_;
  double scan_period_s_;
  std::vector<Bends> bends_;  ///< of a scan that begins at phase zero
};

std::unique_ptr<LidarPattern> make_rings(const PatternRequest& request,
                                         const PluginParams& params) {
  const BeamFan& fan = request.spec.horizontal;
  const std::vector<double> elevations = read_elevations(request.spec.vertical, params);
  const double column_s = request.is_rolling ? fan.increment_rad() / kTurn / request.rate_hz : 0.0;
  const double beam_s = params.number("beamPeriod", 0.0, {0.0, 1.0});
  std::vector<LidarPattern::Beam> beams(elevations.size());
  // The field "ring" of the clouds is a uint16.
  if (beams.size() > std::numeric_limits<std::uint16_t>::max()) {
    throw Error(params.owner() + ": <vertical> has " + std::to_string(beams.size()) +
                " <samples>, must be at most 65535");
  }
  const std::vector<std::size_t> order = read_firing_order(beams.size(), params);
  for (std::size_t i = 0; i < order.size(); ++i) {
    beams[i].ring = static_cast<std::uint16_t>(i);
    if (request.is_rolling) beams[order[i]].time_s = static_cast<double>(i) * beam_s;
  }
  const double last_s = static_cast<double>(beams.size() - 1) * beam_s;
  if (request.is_rolling && fan.beams > 1 && last_s > column_s) {
    params.refuse("beamPeriod", params.text("beamPeriod", "0"),
                  "such that a column, " + std::to_string(1e6 * column_s) +
                      "e-6 s, is not over before its last beam");
  }
  return std::make_unique<RingPattern>(fan, elevations, column_s, std::move(beams));
}

void check_rosette_fan(const PatternRequest& request, const PluginParams& params) {
  const BeamFan& fan = request.spec.horizontal;
  if (request.spec.vertical.beams != 1 || fan.max_rad != -fan.min_rad || !(fan.max_rad > 0.0) ||
      fan.max_rad > 1.5) {
    throw Error(params.owner() +
                ": a rosette needs <horizontal> angles of -a and a, a in (0, 1.5] rad, and no "
                "<vertical> <samples>");
  }
}

std::unique_ptr<LidarPattern> make_rosette(const PatternRequest& request,
                                           const PluginParams& params) {
  check_rosette_fan(request, params);
  const BeamFan& fan = request.spec.horizontal;
  const auto points = static_cast<std::size_t>(fan.beams);
  if (points % RosettePattern::kGroup != 0) {
    throw Error(params.owner() + ": a rosette has " + std::to_string(points) +
                " <horizontal> <samples>, must be a multiple of 8");
  }
  if (!(request.rate_hz > 0.0)) {
    throw Error(params.owner() + ": a rosette needs an <update_rate> > 0");
  }
  constexpr double kRpm = kTurn / 60.0;
  const Limits limits{-1e6, 1e6};
  return std::make_unique<RosettePattern>(
      points, 1.0 / request.rate_hz,
      RosettePattern::Prisms{fan.max_rad, kRpm * params.number("prism1Rpm", 7294.0, limits),
                             kRpm * params.number("prism2Rpm", -4664.0, limits)},
      request.is_rolling);
}

}  // namespace

LidarPattern::LidarPattern(std::size_t columns, double column_period_s, std::vector<Beam> beams,
                           Neighbors neighbors)
    : columns_(columns),
      column_period_s_(column_period_s),
      beams_(std::move(beams)),
      firing_order_(beams_.size()),
      neighbors_(neighbors) {
  std::iota(firing_order_.begin(), firing_order_.end(), std::size_t{0});
  // Stable, so that beams of one time, all of them in a snapshot, stay in the order of the rings.
  std::stable_sort(
      firing_order_.begin(), firing_order_.end(),
      [this](std::size_t a, std::size_t b) { return beams_[a].time_s < beams_[b].time_s; });
}

std::unique_ptr<LidarPattern> make_pattern(const PatternRequest& request,
                                           const PluginParams& params) {
  const std::string name = params.text("pattern", "rings");
  if (name == "rings") return make_rings(request, params);
  if (name == "rosette") return make_rosette(request, params);
  params.refuse("pattern", name, "rings or rosette");
}

}  // namespace trident::sim
