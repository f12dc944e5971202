// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "contact_surface.h"

#include <algorithm>

namespace trident::sim {
namespace {

/// Several contacts under one body hold it more often than it can move, which the exact solver
/// needs a little softness to distinguish: 1e10 N/m at a step of 10 ms, and 1e-8 m/s of creep per
/// newton.
constexpr double kMinNormalCfm = 1e-8;
constexpr double kMinSlip = 1e-8;

/// At which the pose is put right [m/s]; finite, as it is multiplied.
constexpr double kBeyondAnySpeed = 1e9;

}  // namespace

/// Two materials in contact: springs in series and dampers side by side, and of everything else the
/// smaller value. ODE's parameters of an implicit spring and damper over a step dt are erp = dt k /
/// (dt k + d) and cfm = 1 / (dt k + d) (ODE's manual on ERP and CFM).
dSurfaceParameters combine_surfaces(const Surface& a, const Surface& b, double dt_s) {
  dSurfaceParameters surface{};
  const double kp = 1.0 / (1.0 / a.kp_n_m + 1.0 / b.kp_n_m);
  const double kd = a.kd_ns_m + b.kd_ns_m;
  surface.mode = dContactBounce | dContactMu2 | dContactSoftERP | dContactSoftCFM |
                 dContactApprox1 | dContactSlip1 | dContactSlip2;
  surface.mu = std::min(a.mu, b.mu);
  surface.mu2 = std::min(a.mu2, b.mu2);
  surface.slip1 = std::max(kMinSlip, std::min(a.slip1, b.slip1));
  surface.slip2 = std::max(kMinSlip, std::min(a.slip2, b.slip2));
  surface.bounce = std::min(a.restitution, b.restitution);
  surface.bounce_vel = std::min(a.bounce_threshold_m_s, b.bounce_threshold_m_s);
  surface.soft_erp = dt_s * kp / (dt_s * kp + kd);
  surface.soft_cfm = std::max(kMinNormalCfm, 1.0 / (dt_s * kp + kd));
  return surface;
}

/// How deep a contact may stay and how fast it is pushed out. The world's correcting velocity
/// bounds both bodies' own.
Correction combine_corrections(const Surface& a, const Surface* b, const PhysicsSpec& world) {
  Correction pair{a.min_depth_m, a.max_vel_m_s, kBeyondAnySpeed};
  if (b != nullptr) {
    pair.min_depth_m = std::min(pair.min_depth_m, b->min_depth_m);
    pair.max_vel_m_s = std::min(pair.max_vel_m_s, b->max_vel_m_s);
  }
  pair.max_vel_m_s =
      std::min({pair.max_vel_m_s, world.contact_max_correcting_vel, kBeyondAnySpeed});
  return pair;
}

}  // namespace trident::sim
