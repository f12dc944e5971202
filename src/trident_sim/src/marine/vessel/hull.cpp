// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "hull.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

Immersion immersed_power(const HullSection& s, double height) {
  // The breadth is B (z / T)^n; area and centroid are its integrals from the keel up.
  const double part = std::pow(height / s.draft, s.exponent);
  Immersion result;
  result.breadth_m = s.breadth * part;
  result.area_m2 = result.breadth_m * height / (s.exponent + 1.0);
  result.centroid_m = height * (s.exponent + 1.0) / (s.exponent + 2.0);
  return result;
}

Immersion immersed_circle(double radius, double height) {
  // A segment of a circle from its lowest point up.
  const double square = std::max(0.0, 2.0 * radius * height - height * height);
  const double half_chord = std::sqrt(square);
  Immersion result;
  result.breadth_m = 2.0 * half_chord;
  result.area_m2 = radius * radius * std::acos(std::clamp((radius - height) / radius, -1.0, 1.0)) -
                   (radius - height) * half_chord;
  result.centroid_m =
      result.area_m2 > 0.0 ? radius - 2.0 / 3.0 * square * half_chord / result.area_m2 : 0.0;
  return result;
}

/// A rectangle on top.
Immersion with_wall(const Immersion& below, double height_below, double wall) {
  Immersion result;
  result.breadth_m = below.breadth_m;
  result.area_m2 = below.area_m2 + below.breadth_m * wall;
  result.centroid_m =
      (below.area_m2 * below.centroid_m + below.breadth_m * wall * (height_below + 0.5 * wall)) /
      result.area_m2;
  return result;
}

/// The surface over a slice: its height above the slice's keel and its slope, in body axes.
struct LocalSurface {
  double height_m;
  double slope_x, slope_y;
};

/// `n_body` is the surface's normal, up; `gap_m` how far the surface lies above the point.
LocalSurface surface_over(const Eigen::Vector3d& n_body, double gap_m, const HullSection& section) {
  // A hull that lies on its side or upside down is either in the water or not.
  constexpr double kLyingCosine = 0.15;
  if (n_body.z() < kLyingCosine) {
    return {gap_m > 0.0 ? section.draft + section.freeboard : 0.0, 0.0, 0.0};
  }
  return {section.draft + gap_m / n_body.z(), -n_body.x() / n_body.z(), -n_body.y() / n_body.z()};
}

double ratio_or_zero(double numerator, double denominator) {
  return denominator > 1e-12 ? numerator / denominator : 0.0;
}

}  // namespace

Immersion immersion(const HullSection& section, double height_m) {
  const double height = std::clamp(height_m, 0.0, section.draft + section.freeboard);
  if (height <= 0.0) return {};
  const bool is_circle = section.shape == SectionShape::kCircle;
  const double wall_from = is_circle ? 0.5 * section.breadth : section.draft;
  const double curved = std::min(height, wall_from);
  const Immersion below =
      is_circle ? immersed_circle(wall_from, curved) : immersed_power(section, curved);
  return height > wall_from ? with_wall(below, wall_from, height - wall_from) : below;
}

/// GM = KB + I / V - KG, heights from the design waterline here.
double Hydrostatics::gm_transverse_m(double z_cg) const {
  return center_of_buoyancy_z_m + inertia_transverse_m4 / displaced_m3 - z_cg;
}

double Hydrostatics::gm_longitudinal_m(double z_cg) const {
  return center_of_buoyancy_z_m + inertia_longitudinal_m4 / displaced_m3 - z_cg;
}

Hull::Hull(const HullParams& params, double water_density, double gravity_m_s2)
    : density_(water_density), gravity_(gravity_m_s2) {
  for (const double y : params.offsets) {
    for (const HullSection& section : params.sections) {
      // Depths of the center of buoyancy, and the mean draft, area by breadth.
      const Immersion design = immersion(section, section.draft);
      slices_.push_back(
          {section, y, {section.draft - design.centroid_m, design.area_m2 / design.breadth_m}});
    }
  }
}

/// Sums over the slices, body axes. The water's motion is a mean and, per axis, a regression over
/// the hull, all weighted by the immersed volume.
struct Hull::Accumulator {
  Vector6d wrench = Vector6d::Zero();
  double volume = 0.0;
  double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0;
  struct Motion {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double x_vy = 0.0, x_vz = 0.0, y_vz = 0.0;

    void add(double volume, double x, double y, const Eigen::Vector3d& v) {
      sum += volume * v;
      x_vy += volume * x * v.y();
      x_vz += volume * x * v.z();
      y_vz += volume * y * v.z();
    }
  };
  Motion velocity, acceleration;

  /// Rigid motion that fits the water's, about CO.
  Vector6d fit(const Motion& motion) const {
    Vector6d result = Vector6d::Zero();
    if (volume <= 0.0) return result;
    const Eigen::Vector3d mean = motion.sum / volume;
    const double mean_x = x / volume, mean_y = y / volume;
    const double spread_x = xx - volume * mean_x * mean_x;
    const double spread_y = yy - volume * mean_y * mean_y;
    const Eigen::Vector3d w(ratio_or_zero(motion.y_vz - volume * mean_y * mean.z(), spread_y),
                            -ratio_or_zero(motion.x_vz - volume * mean_x * mean.z(), spread_x),
                            ratio_or_zero(motion.x_vy - volume * mean_x * mean.y(), spread_x));
    result << mean - w.cross(Eigen::Vector3d(mean_x, mean_y, 0.0)), w;
    return result;
  }
};

void Hull::add_slice(const Slice& slice, const SE3& T_world_co, const Water& water, double time_s,
                     Accumulator* sum) const {
  const HullSection& s = slice.section;
  const Eigen::Vector3d at_waterline(s.x, slice.y_m, 0.0);
  const Eigen::Vector3d p = T_world_co * at_waterline;
  const WaterColumn column = water.column(p.head<2>(), slice.depths_m, time_s);
  const Eigen::Quaterniond R_body_world = T_world_co.R.conjugate();
  // The surface over a slice is a plane, with the height and slope of the water at its middle.
  const Eigen::Vector3d n_body =
      R_body_world * Eigen::Vector3d(-column.slope.x(), -column.slope.y(), 1.0);
  const LocalSurface surface = surface_over(n_body, column.elevation_m - p.z(), s);
  const Immersion wet = immersion(s, surface.height_m);
  if (wet.area_m2 <= 0.0) return;

  // The wedge by which the tilted surface differs from a level one moves the centre of buoyancy.
  const double tilt_y = wet.breadth_m * wet.breadth_m * wet.breadth_m / (12.0 * wet.area_m2);
  const double tilt_x = wet.breadth_m * s.length * s.length / (12.0 * wet.area_m2);
  const double dy = std::clamp(tilt_y * surface.slope_y, -0.5 * wet.breadth_m, 0.5 * wet.breadth_m);
  const double dx = std::clamp(tilt_x * surface.slope_x, -0.5 * s.length, 0.5 * s.length);
  const double dz = 0.5 * (dy * surface.slope_y + dx * surface.slope_x);
  const Eigen::Vector3d center =
      at_waterline + Eigen::Vector3d(dx, dy, wet.centroid_m - s.draft + dz);

  const double volume = wet.area_m2 * s.length;
  // Buoyancy and Froude-Krylov force in one: the undisturbed water in the hull's place would need
  // this force to accelerate as it does.
  const Eigen::Vector3d force =
      R_body_world *
      (density_ * volume * (Eigen::Vector3d(0.0, 0.0, gravity_) + column.motion[0].acceleration));
  sum->wrench.head<3>() += force;
  sum->wrench.tail<3>() += center.cross(force);
  sum->volume += volume;
  sum->x += volume * s.x;
  sum->y += volume * slice.y_m;
  sum->xx += volume * s.x * s.x;
  sum->yy += volume * slice.y_m * slice.y_m;
  sum->velocity.add(volume, s.x, slice.y_m, R_body_world * column.motion[1].velocity);
  sum->acceleration.add(volume, s.x, slice.y_m, R_body_world * column.motion[1].acceleration);
}

HullLoad Hull::load(const SE3& T_world_co, const Water& water, double time_s) const {
  Accumulator sum;
  for (const Slice& slice : slices_) add_slice(slice, T_world_co, water, time_s, &sum);
  HullLoad result;
  result.wrench = sum.wrench;
  result.displaced_m3 = sum.volume;
  result.water.velocity = sum.fit(sum.velocity);
  result.water.acceleration = sum.fit(sum.acceleration);
  return result;
}

Hydrostatics Hull::hydrostatics() const {
  Hydrostatics h;
  double plane_x = 0.0, plane_xx = 0.0;
  for (const Slice& slice : slices_) {
    const HullSection& s = slice.section;
    const Immersion wet = immersion(s, s.draft);
    const double plane = wet.breadth_m * s.length, volume = wet.area_m2 * s.length;
    h.displaced_m3 += volume;
    h.waterplane_m2 += plane;
    h.center_of_buoyancy_x_m += volume * s.x;
    h.center_of_buoyancy_z_m += volume * (wet.centroid_m - s.draft);
    plane_x += plane * s.x;
    plane_xx += plane * (s.x * s.x + s.length * s.length / 12.0);
    h.inertia_transverse_m4 +=
        plane * (slice.y_m * slice.y_m + wet.breadth_m * wet.breadth_m / 12.0);
  }
  if (h.displaced_m3 <= 0.0) return h;
  h.center_of_buoyancy_x_m /= h.displaced_m3;
  h.center_of_buoyancy_z_m /= h.displaced_m3;
  h.center_of_flotation_x_m = plane_x / h.waterplane_m2;
  // Steiner's theorem: about the center of flotation.
  h.inertia_longitudinal_m4 = plane_xx - plane_x * plane_x / h.waterplane_m2;
  return h;
}

StaticPose Hull::rest(double mass_kg, const Eigen::Vector3d& center_of_gravity) const {
  const StillWater water;
  // Heave and pitch at which weight and buoyancy cancel, by Newton's method on a numeric Jacobian.
  const auto residual = [&](const StaticPose& pose) -> Eigen::Vector2d {
    const SE3 T = SE3::from_xyz_rpy({0.0, 0.0, pose.z_m}, 0.0, pose.pitch_rad, 0.0);
    const Eigen::Vector3d weight = T.R.conjugate() * Eigen::Vector3d(0.0, 0.0, -mass_kg * gravity_);
    const HullLoad wet = load(T, water, 0.0);
    const Eigen::Vector3d force = T.R * (wet.wrench.head<3>() + weight);
    return {force.z(), wet.wrench[4] + center_of_gravity.cross(weight).y()};
  };
  constexpr int kMaxSteps = 100;
  constexpr double kStep = 1e-6;
  StaticPose pose;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Eigen::Vector2d r = residual(pose);
    if (r.cwiseAbs().maxCoeff() < 1e-9 * mass_kg * gravity_) return pose;
    Eigen::Matrix2d J;
    J.col(0) = (residual({pose.z_m + kStep, pose.pitch_rad}) - r) / kStep;
    J.col(1) = (residual({pose.z_m, pose.pitch_rad + kStep}) - r) / kStep;
    // Short steps: the sections end at keel and deck.
    const Eigen::Vector2d step = -(J.fullPivLu().solve(r)).cwiseMin(0.05).cwiseMax(-0.05);
    pose.z_m += step[0];
    pose.pitch_rad += step[1];
  }
  throw Error("hull: it cannot carry " + number_text(mass_kg) +
              " kg: its sections displace too little, or lie too far from the centre of gravity");
}

}  // namespace trident::sim
