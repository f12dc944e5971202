// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_painter.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr float kPiF = static_cast<float>(kPi);
constexpr float kMirror = 0.02F;  ///< Fresnel's reflectivity straight on
/// Mean square of the slopes of ripples, which the sea's spectrum has not. They are drawn as the
/// tile's own slopes at a fraction of its size, where it has any.
constexpr float kRipples = 0.006F;
constexpr double kRippleScale = 11.0;
constexpr float kSmoothest = 0.001F;  ///< of what spreads the sun's light

/// Of light from above that comes out of deep water again; what is left of light after a metre.
const Eigen::Vector3f kDeep(0.024F, 0.155F, 0.205F);
const Eigen::Vector3f kExtinction(0.45F, 0.12F, 0.09F);  ///< [1/m]
constexpr float kClear_m = 60.0F;                        ///< beyond it nothing is left
/// The zenith's colour, as a part of the horizon's.
const Eigen::Vector3f kZenith(0.36F, 0.55F, 0.85F);

float to_the_fifth(float x) { return x * x * (x * x) * x; }
float fresnel_of(float cosine) { return kMirror + (1.0F - kMirror) * to_the_fifth(1.0F - cosine); }

}  // namespace

/// Where a ray hits the surface, and how that leans there.
struct WaterPainter::Facet {
  bool is_hit = false;
  Eigen::Vector3f p, normal, to_eye;
  Eigen::Vector2f slope;
  float spread;  ///< mean square of slopes about this one
};

void WaterPainter::begin_picture(const World& world, const RayScene& scene, float pixel_angle_rad) {
  scene_ = &scene;
  water_ = as_water(scene.surface());
  pixel_angle_ = pixel_angle_rad;
  slopes_.follow(*water_);
  const float square = slopes_.mean_square();
  ripple_strength_ = square > 0.0F ? std::sqrt(kRipples / square) : 0.0F;
  background_ = world.scene().background.head<3>().cast<float>();
  suns_.clear();
  Eigen::Vector3f light = world.scene().ambient.head<3>().cast<float>();
  for (const LightSpec& lamp : world.lights()) {
    if (lamp.type != LightType::kDirectional) continue;
    const Eigen::Vector3f to_sun = -(lamp.T_world_light.R * lamp.direction_light).cast<float>();
    if (to_sun.z() <= 0.0F) continue;
    const Eigen::Vector3f color = lamp.diffuse.head<3>().cast<float>();
    suns_.push_back({to_sun.normalized(), color, lamp.casts_shadows && world.scene().shadows});
    light += to_sun.z() * color;
  }
  deep_ = kDeep.cwiseProduct(light);
}

/// The sky in a direction whose sine above the horizon is `up`.
Eigen::Vector3f WaterPainter::sky(float up) const {
  const float share = std::sqrt(std::clamp(up, 0.0F, 1.0F));
  const Eigen::Vector3f zenith = background_.cwiseProduct(kZenith);
  return background_ + share * (zenith - background_);
}

WaterPainter::Facet WaterPainter::facet_of(const WaterView& view, std::size_t lane) const {
  Facet facet;
  const double t = view.water_hits[lane].t;
  facet.is_hit = std::isfinite(t);
  if (!facet.is_hit) return facet;
  const Eigen::Vector3f d(view.d_x[lane], view.d_y[lane], view.d_z[lane]);
  const Eigen::Vector3d p = view.p_world_camera + t * d.cast<double>();
  const float length = d.norm();
  facet.p = p.cast<float>();
  facet.to_eye = d / -length;
  // What a pixel covers of water that it sees aslant is longer than wide; the mean of both.
  const double aslant = std::max(std::abs(static_cast<double>(facet.to_eye.z())), 1e-3);
  const double width_m =
      t * static_cast<double>(length) * static_cast<double>(pixel_angle_) / std::sqrt(aslant);
  facet.slope.setZero();
  facet.spread = kRipples;
  if (water_->tile() != nullptr) {
    const auto strength = static_cast<float>(water_->strength(p.head<2>()));
    const WaterSlopes::Mean waves = slopes_.at(p.head<2>(), width_m).times(strength);
    const WaterSlopes::Mean ripples =
        slopes_.at(kRippleScale * p.head<2>(), kRippleScale * width_m).times(ripple_strength_);
    facet.slope = slopes_.in_world(waves.slope + ripples.slope);
    facet.spread = std::max(waves.spread() + ripples.spread(), kSmoothest);
  }
  facet.normal = Eigen::Vector3f(-facet.slope.x(), -facet.slope.y(), 1.0F).normalized();
  return facet;
}

Eigen::Vector3f WaterPainter::through_water(const Eigen::Vector3f& color, float path_m) const {
  if (path_m > kClear_m) return deep_;
  const Eigen::Array3f left = (-path_m * kExtinction.array()).exp();
  return (left * color.array() + (1.0F - left) * deep_.array()).matrix();
}

Eigen::Vector3f WaterPainter::from_above(const Facet& facet, const Eigen::Vector3f& body) const {
  const float cosine = std::max(facet.normal.dot(facet.to_eye), 0.01F);
  const float sigma = std::sqrt(0.5F * facet.spread);  // along the line of sight
  const float rough = std::exp(-2.69F * sigma) / (1.0F + 22.7F * sigma * std::sqrt(sigma));
  const float fresnel = kMirror + (1.0F - kMirror) * to_the_fifth(1.0F - cosine) * rough;
  // Slopes that are seen lean towards the eye, and so show what is higher up.
  const float up = 2.0F * cosine * facet.normal.z() - facet.to_eye.z();
  return fresnel * sky(std::abs(up) + sigma) + (1.0F - fresnel) * body;
}

Eigen::Vector3f WaterPainter::from_below(const Facet& facet) const {
  constexpr float kCritical = 0.66F;  ///< cosine of the angle beyond which the surface is a mirror
  const float cosine = std::abs(facet.normal.dot(facet.to_eye));
  const float window = std::clamp((cosine - kCritical) / 0.08F, 0.0F, 1.0F);
  return deep_ + window * (sky(1.0F) - deep_);
}

/// The sun as slopes mirror it that lean halfway between it and the eye.
void WaterPainter::add_glitter(const Sun& sun, const std::array<Facet, kPacketLanes>& facets,
                               PacketColor& color) const {
  constexpr float kFaint = 0.004F, kRarest = 15.0F;
  PacketFloats strength{};
  RayPacket to_sun;
  to_sun.valid.fill(0);
  bool is_seen = false;
  for (std::size_t i = 0; i < kPacketLanes; ++i) {
    const Facet& facet = facets[i];
    to_sun.origin_x[i] = to_sun.origin_y[i] = to_sun.origin_z[i] = 0.0F;
    if (!facet.is_hit) continue;
    const Eigen::Vector3f half = (sun.to_sun + facet.to_eye).normalized();
    const Eigen::Vector2f slope = -half.head<2>() / std::max(half.z(), 1e-3F);
    const float rare = (slope - facet.slope).squaredNorm() / facet.spread;
    if (rare > kRarest) continue;
    const float density = std::exp(-rare) / (kPiF * facet.spread);
    const float up = half.z() * half.z();
    const float cosine = std::max(half.dot(facet.to_eye), 0.0F);
    const float eye = std::max(facet.normal.dot(facet.to_eye), 0.05F);
    // Lambert's surfaces are as bright as the light that falls on them: pi times the radiance.
    strength[i] = kPiF * fresnel_of(cosine) * density / (4.0F * eye * up * up);
    if (!(strength[i] > kFaint)) continue;
    is_seen = true;
    to_sun.valid[i] = -1;
    to_sun.origin_x[i] = facet.p.x();
    to_sun.origin_y[i] = facet.p.y();
    to_sun.origin_z[i] = facet.p.z();
  }
  if (!is_seen) return;
  to_sun.direction_x.fill(sun.to_sun.x());
  to_sun.direction_y.fill(sun.to_sun.y());
  to_sun.direction_z.fill(sun.to_sun.z());
  to_sun.t_min.fill(1e-3F);
  to_sun.t_max.fill(1e6F);
  const std::uint32_t shaded = sun.casts_shadows ? PacketRays(*scene_).shaded(to_sun) : 0U;
  for (std::size_t i = 0; i < kPacketLanes; ++i) {
    if (to_sun.valid[i] == 0 || (shaded >> i & 1U) != 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      color[k][i] += strength[i] * sun.color[static_cast<Eigen::Index>(k)];
    }
  }
}

void WaterPainter::paint(const WaterView& view, PacketColor& color) const {
  std::array<Facet, kPacketLanes> glittering;
  for (std::size_t i = 0; i < kPacketLanes; ++i) {
    const WaterHit& water_hit = view.water_hits[i];
    const Facet facet = facet_of(view, i);
    if (!facet.is_hit && !water_hit.begins_below) continue;
    const float length = Eigen::Vector3f(view.d_x[i], view.d_y[i], view.d_z[i]).norm();
    const Eigen::Vector3f behind(color[0][i], color[1][i], color[2][i]);
    Eigen::Vector3f seen;
    if (water_hit.begins_below) {
      const auto path_m =
          length * (facet.is_hit ? static_cast<float>(water_hit.t) : view.behind[i]);
      seen = through_water(facet.is_hit ? from_below(facet) : behind, path_m);
    } else {
      const float path_m = length * (view.behind[i] - static_cast<float>(water_hit.t));
      seen = from_above(facet, through_water(behind, path_m));
      glittering[i] = facet;
    }
    for (std::size_t k = 0; k < 3; ++k) color[k][i] = seen[static_cast<Eigen::Index>(k)];
  }
  for (const Sun& sun : suns_) add_glitter(sun, glittering, color);
}

}  // namespace trident::sim
