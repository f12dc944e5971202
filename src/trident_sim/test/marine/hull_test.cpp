// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/vessel/hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "marine/environment/wave_field.h"
#include "standalone_vessel.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kDensity = 1000.0, kGravity = 9.81;

struct Barge {
  double length = 10.0, breadth = 1.5, draft = 0.5;
  double mass() const { return kDensity * length * breadth * draft; }
};

HullParams box(const Barge& barge, int sections = 20) {
  HullParams hull;
  for (int i = 0; i < sections; ++i) {
    HullSection section;
    section.length = barge.length / sections;
    section.x = -0.5 * barge.length + (i + 0.5) * section.length;
    section.breadth = barge.breadth;
    section.draft = barge.draft;
    hull.sections.push_back(section);
  }
  return hull;
}

/// A box with added mass and inertia equal to its own, as Jensen's closed forms have it.
VesselParams box_vessel(const Barge& barge, double z_cg) {
  VesselParams params;
  params.name = "barge";
  params.water_density = kDensity;
  params.mass = barge.mass();
  params.center_of_gravity = {0, 0, z_cg};
  const double I_long = barge.mass() * barge.length * barge.length / 12.0;
  params.inertia = {barge.mass() * barge.breadth * barge.breadth / 8.0, I_long, I_long};
  params.added_mass << 0, barge.mass(), barge.mass(), 0.2 * params.inertia.x(), I_long, I_long;
  params.hull = box(barge);
  return params;
}

TEST(HullSection, ShapesHaveTheAreasAndCentroidsOfTheirFormulas) {
  HullSection v;
  v.length = 1.0;
  v.breadth = 0.4;
  v.draft = 0.2;
  v.exponent = 1.0;
  v.freeboard = 0.1;
  EXPECT_NEAR(immersion(v, 0.1).area_m2, 0.5 * 0.2 * 0.1, 1e-12);
  EXPECT_NEAR(immersion(v, 0.1).centroid_m, 0.2 / 3.0, 1e-12);
  EXPECT_NEAR(immersion(v, 0.25).area_m2, 0.04 + 0.4 * 0.05, 1e-12);
  EXPECT_NEAR(immersion(v, 9.0).area_m2, 0.04 + 0.4 * 0.1, 1e-12);
  EXPECT_EQ(immersion(v, -0.1).area_m2, 0.0);

  v.shape = SectionShape::kCircle;
  EXPECT_NEAR(immersion(v, 0.2).area_m2, 0.5 * kPi * 0.04, 1e-12);
  EXPECT_NEAR(immersion(v, 0.2).centroid_m, 0.2 - 4.0 * 0.2 / (3.0 * kPi), 1e-12);
  EXPECT_NEAR(immersion(v, 0.1).breadth_m, 2.0 * std::sqrt(0.04 - 0.01), 1e-12);
}

/// VRX' buoyancy of a point of its hull: A_seg(R, h) of a cylinder's segment.
TEST(HullSection, CircleIsVrxSegment) {
  HullSection section;
  section.shape = SectionShape::kCircle;
  section.breadth = 0.426;
  section.draft = 0.0796;
  const double R = 0.213, h = 0.0796;
  EXPECT_NEAR(immersion(section, h).area_m2,
              R * R * std::acos((R - h) / R) - (R - h) * std::sqrt(2 * R * h - h * h), 1e-12);
}

TEST(Hull, BoxHasTheClosedFormHydrostatics) {
  const Barge b;
  const Hydrostatics h = Hull(box(b), kDensity, kGravity).hydrostatics();
  EXPECT_NEAR(h.displaced_m3, 7.5, 1e-9);
  EXPECT_NEAR(h.gm_transverse_m(0.1), -0.25 + 1.5 * 1.5 / (12 * 0.5) - 0.1, 1e-9);
  EXPECT_NEAR(h.gm_longitudinal_m(0.1), -0.25 + 100.0 / (12 * 0.5) - 0.1, 1e-9);
}

/// Archimedes' force in a heeled and trimmed box is that of the wall-sided formula.
TEST(Hull, HeeledBoxRightsAsWallSided) {
  const Barge b;
  const Hull hull(box(b, 200), kDensity, kGravity);
  const double heel = 0.2, bm = b.breadth * b.breadth / (12 * b.draft);
  // The waterplane's middle stays at the surface.
  const HullLoad load = hull.load(SE3::from_xyz_rpy({0, 0, 0}, heel, 0, 0), StillWater(), 0.0);
  const double buoyancy = load.wrench.head<3>().norm();
  EXPECT_NEAR(buoyancy, b.mass() * kGravity, 1e-6 * buoyancy);
  // Moment about CO: -W sin(heel) (z_B + BM (1 + tan^2 / 2)).
  const double lever = -0.25 + bm * (1.0 + 0.5 * std::pow(std::tan(heel), 2));
  EXPECT_NEAR(load.wrench[3] / (-buoyancy * std::sin(heel) * lever), 1.0, 1e-6);
  const HullLoad trimmed = hull.load(SE3::from_xyz_rpy({0, 0, 0}, 0, 0.02, 0), StillWater(), 0.0);
  const double lever_l = -0.25 + 100.0 / (12 * 0.5) * (1.0 + 0.5 * std::pow(std::tan(0.02), 2));
  EXPECT_NEAR(trimmed.wrench[4] / (-buoyancy * std::sin(0.02) * lever_l), 1.0, 1e-4);
}

TEST(Hull, RestsAtTheDraftAndTrimOfTheClosedForm) {
  const Barge b;
  const Hull hull(box(b), kDensity, kGravity);
  // A tenth lighter: 5 cm less draft. The centre of gravity 1 cm ahead: tan(trim) = x / GM_L.
  const double mass = 0.9 * b.mass(), draft = 0.45;
  const StaticPose rest = hull.rest(mass, {0.01, 0, 0.0});
  EXPECT_NEAR(rest.z_m, 0.05, 1e-4);
  const double gm = -0.05 - draft / 2 + 100.0 / (12 * draft);
  EXPECT_NEAR(rest.pitch_rad / (0.01 / gm), 1.0, 0.01);
  EXPECT_TRUE(contains(error_of([&] { hull.rest(10.0 * b.mass(), {0, 0, 0}); }), "cannot carry"));
}

TEST(Hull, OutOfTheWaterAndUpsideDownItIsStillFinite) {
  const Hull hull(box(Barge()), kDensity, kGravity);
  EXPECT_EQ(hull.load(SE3::from_xyz_rpy({0, 0, 2}, 0, 0, 0), StillWater(), 0).wrench.norm(), 0.0);
  for (double roll = 0.0; roll < 2 * kPi; roll += 0.1) {
    const HullLoad load = hull.load(SE3::from_xyz_rpy({0, 0, -0.1}, roll, 0.3, 0), StillWater(), 0);
    EXPECT_TRUE(load.wrench.allFinite());
    EXPECT_LE(load.displaced_m3, 10.0 * 1.5 * 1.0 + 1e-9);
  }
}

/// Period and damping ratio of what swings about 0, from its zero crossings and peaks.
struct Decay {
  double period_s, ratio;
};
template <class Value>
Decay decay_of(StandaloneVessel* boat, Value value) {
  constexpr double kStep = 1e-3;
  std::vector<double> crossings, peaks;
  double last = value(*boat), peak = 0.0;
  while (crossings.size() < 5 && boat->time_s() < 100.0) {
    boat->step(Vector6d::Zero(), kStep);
    const double now = value(*boat);
    if (last * now < 0.0) {
      crossings.push_back(boat->time_s() - kStep * now / (now - last));
      peaks.push_back(peak);
      peak = 0.0;
    }
    peak = std::max(peak, std::abs(now));
    last = now;
  }
  if (crossings.size() < 5) return {0.0, 0.0};
  const double decrement = std::log(peaks[1] / peaks[4]) / 3.0;  // of half a period
  return {(crossings[4] - crossings[0]) / 2.0, decrement / std::hypot(kPi, decrement)};
}

void expect_decay(int axis, const SE3& start, double stiffness) {
  VesselParams params = box_vessel(Barge(), 0.0);
  const Vector6d damping_ratio = Vector6d::Constant(0.1);
  const VesselDynamics undamped(params);
  const double M = (undamped.rigid_body_mass() + undamped.added_mass())(axis, axis);
  const double omega = std::sqrt(stiffness / M);
  params.linear_damping[axis] = 2.0 * damping_ratio[axis] * omega * M;
  StandaloneVessel barge(params);
  barge.set_pose(start);
  const Decay decay = decay_of(&barge, [axis](const StandaloneVessel& b) {
    return axis == 2 ? b.T_world_co().p.z() : b.T_world_co().rpy()[axis - 3];
  });
  EXPECT_NEAR(decay.period_s / (2 * kPi / omega / std::sqrt(1 - 0.01)), 1.0, 0.01) << axis;
  EXPECT_NEAR(decay.ratio, 0.1, 0.003) << axis;
}

TEST(Hull, FreeDecayHasTheClosedFormsPeriodAndDamping) {
  const Barge b;
  const double weight = b.mass() * kGravity;
  expect_decay(2, at(0, 0, 0.02), kDensity * kGravity * b.length * b.breadth);
  expect_decay(3, SE3::from_xyz_rpy({0, 0, 0}, 0.03, 0, 0), weight * (-0.25 + 2.25 / 6.0));
  expect_decay(4, SE3::from_xyz_rpy({0, 0, 0}, 0, 0.004, 0), weight * (-0.25 + 100.0 / 6.0));
}

/// Jensen, Mansour, Olsen: "Estimation of ship motions using closed-form expressions", Ocean
/// Engineering 31 (2004), a box in head seas without speed.
struct ClosedForm {
  double heave, pitch;  ///< per wave amplitude [m/m], [rad/m]
  double damping_heave, damping_pitch;
};
ClosedForm jensen(const Barge& b, double k) {
  const double omega = std::sqrt(kGravity * k);
  const double A = 2.0 * std::sin(0.5 * k * b.breadth) * std::exp(-k * b.draft);
  const double loss = A * A / (k * b.breadth);
  const double f = std::exp(-k * b.draft) * std::hypot(1.0 - k * b.draft, loss);
  const double eta = 1.0 / std::hypot(1.0 - 2.0 * k * b.draft, loss);
  const double half = 0.5 * k * b.length;
  ClosedForm result{};
  result.heave = eta * f * std::abs(std::sin(half)) / half;
  result.pitch =
      eta * f * 6.0 / (half * half * b.length) * std::abs(std::sin(half) - half * std::cos(half));
  result.damping_heave = kDensity * kGravity * b.length * A * A / (k * omega);
  result.damping_pitch = result.damping_heave * b.length * b.length / 12.0;
  return result;
}

struct Amplitudes {
  double heave, pitch;
};
Amplitudes simulated(const Barge& b, double k, const ClosedForm& closed) {
  VesselParams params = box_vessel(b, -0.5 * b.draft);
  params.linear_damping << 0.05 * params.mass, 1e3, closed.damping_heave, 1e3, closed.damping_pitch,
      1e3;
  StandaloneVessel barge(params);
  const double omega = std::sqrt(kGravity * k), period = 2 * kPi / omega;
  WaveParams waves;
  waves.spectrum = WaveSpectrum::kRegular;
  waves.amplitude = 0.01 / k;
  waves.period = period;
  waves.direction = kPi;
  waves.ramp_time = 5.0 * period;
  const WaveField sea(waves, 1);
  const int per_period = 400, periods = 60;
  const double dt = period / per_period;
  std::complex<double> heave = 0.0, pitch = 0.0;
  for (int i = 0; i < periods * per_period; ++i) {
    barge.step(Vector6d::Zero(), dt, sea, Current(CurrentParams{}));
    if (i < (periods - 10) * per_period) continue;
    const std::complex<double> turn = std::polar(2.0 / (10 * per_period), -omega * barge.time_s());
    heave += turn * (barge.T_world_co() * Eigen::Vector3d(0, 0, -0.5 * b.draft)).z();
    pitch += turn * barge.T_world_co().rpy().y();
  }
  return {std::abs(heave) / waves.amplitude, std::abs(pitch) / waves.amplitude};
}

class BargeInWaves : public testing::TestWithParam<double> {};

TEST_P(BargeInWaves, HeaveAndPitchAreThoseOfTheClosedForm) {
  const Barge b;
  const double k = 2 * kPi / (GetParam() * b.length);
  const ClosedForm closed = jensen(b, k);
  const Amplitudes barge = simulated(b, k, closed);
  RecordProperty("heave", std::to_string(barge.heave) + " of " + std::to_string(closed.heave));
  RecordProperty("pitch", std::to_string(barge.pitch) + " of " + std::to_string(closed.pitch));
  EXPECT_NEAR(barge.heave / closed.heave, 1.0, 0.05) << barge.heave;
  EXPECT_NEAR(barge.pitch / closed.pitch, 1.0, 0.05) << barge.pitch;
}

INSTANTIATE_TEST_SUITE_P(WavelengthOverLength, BargeInWaves, testing::Values(2.0, 3.0, 5.0, 10.0));

}  // namespace
}  // namespace trident::sim
