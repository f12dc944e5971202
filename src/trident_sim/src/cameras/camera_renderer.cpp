// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../rays/textures/texture.h"
#include "image_noise.h"
#include "surface_cache.h"

namespace trident::sim {
namespace {

constexpr std::size_t kLanes = kPacketLanes;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kHalf = 0.5F;  // rounds when cut off

float within_one(float value) {
  const float at_most = value < 1.0F ? value : 1.0F;
  return at_most > 0.0F ? at_most : 0.0F;
}

void set_lane(PacketColor& colors, std::size_t lane, const Eigen::Vector3f& color) {
  for (std::size_t i = 0; i < 3; ++i) colors[i][lane] = color[static_cast<Eigen::Index>(i)];
}

}  // namespace

/// What one picture is drawn with.
struct CameraRenderer::Frame {
  const RayScene& scene;
  Lighting lighting;
  PixelNoise noise;
  Eigen::Vector3d p_world_camera;
  Eigen::Vector3f x_world, y_world, z_world;  ///< axes of the optical frame
  Eigen::Vector3f background;
  const WaterSurface* water;  ///< nullptr: none
  float pixel_angle;          ///< about that which a pixel spans in the middle of the picture [rad]
};

/// What the rays of one tile hit, and the surfaces that those before it hit.
struct CameraRenderer::Seen {
  SurfaceCache surfaces;
  RayPacket rays;
  PacketHits hits;
  std::array<double, kLanes> depths;
  LitPoints points;
  WaterView water;
};

CameraRenderer::CameraRenderer(World& world, const CameraSpec& spec, const CameraModel& model,
                               const std::string& owner)
    : world_(world),
      spec_(spec),
      width_(model.width),
      height_(model.height),
      pixel_angle_(static_cast<float>(1.0 / model.fx)),
      table_(model, owner) {
  for (std::size_t worker = 0; worker < world.workers().threads(); ++worker) {
    seen_.push_back(std::make_unique<Seen>());
  }
}

CameraRenderer::~CameraRenderer() = default;

void CameraRenderer::render(const SE3& T_world_camera, std::uint64_t noise_key, Picture& picture) {
  RayScene& scene = rays(world_, RayGeometry::kVisual);
  // The scene is brought to the present poses once; workers only read it from here.
  scene.use_textures();
  scene.refresh();
  const std::shared_ptr<const WaterSurface> water =
      as_water(scene.refresh_surface(T_world_camera.p));
  if (water != nullptr) water_.begin_picture(world_, scene, pixel_angle_);
  for (const auto& seen : seen_) seen->surfaces.begin_picture(scene, T_world_camera.p);
  const Eigen::Matrix3f R = T_world_camera.R.toRotationMatrix().cast<float>();
  // From axes of the sensor (x ahead) to those of the
  // optical frame (z ahead, x right, y down; REP 103).
  const Frame frame{scene,
                    Lighting(world_, scene),
                    PixelNoise(noise_key),
                    T_world_camera.p,
                    -R.col(1),
                    -R.col(2),
                    R.col(0),
                    world_.scene().background.head<3>().cast<float>(),
                    water.get(),
                    pixel_angle_};
  make_room(picture);
  // A row of tiles is a part of the work: what it draws depends on no other.
  const auto rows = static_cast<std::size_t>(table_.tile_rows());
  world_.workers().share(rows, [&](std::size_t row, std::size_t worker) {
    for (int column = 0; column < table_.tile_columns(); ++column) {
      render_tile(frame, column, static_cast<int>(row), *seen_[worker], picture);
    }
  });
}

void CameraRenderer::make_room(Picture& picture) const {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  if (picture.wants_colors) {
    picture.colors.resize(pixels * static_cast<std::size_t>(channel_count(spec_.format)));
  }
  if (picture.wants_depths) picture.depths.resize(pixels);
  if (picture.wants_shapes) picture.shapes.resize(pixels);
}

/// Calls store(lane, pixel) for the pixels of a tile that are within the picture.
template <class Store>
void CameraRenderer::for_pixels(int column, int row, Store&& store) const {
  constexpr int kSide = ViewTable::kSide;
  const int columns = std::min(kSide, width_ - column * kSide);
  const int rows = std::min(kSide, height_ - row * kSide);
  for (int y = 0; y < rows; ++y) {
    const std::size_t first =
        static_cast<std::size_t>(row * kSide + y) * static_cast<std::size_t>(width_) +
        static_cast<std::size_t>(column * kSide);
    for (int x = 0; x < columns; ++x) {
      store(ViewTable::lane_of(x, y), first + static_cast<std::size_t>(x));
    }
  }
}

void CameraRenderer::render_tile(const Frame& frame, int column, int row, Seen& seen,
                                 Picture& picture) const {
  // First all hits, then depths and labels, then colors: light and textures are for the last alone.
  see(frame, table_.tile(column, row), picture.wants_colors, seen);
  if (frame.water != nullptr) see_water(frame, seen);
  if (picture.wants_depths) {
    for_pixels(column, row, [&](std::size_t lane, std::size_t pixel) {
      picture.depths[pixel] = static_cast<float>(seen.depths[lane]);
    });
  }
  if (picture.wants_shapes) {
    for_pixels(column, row, [&](std::size_t lane, std::size_t pixel) {
      picture.shapes[pixel] = seen.hits.shape[lane];
    });
  }
  if (!picture.wants_colors) return;
  PacketColor color;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    color[channel].fill(frame.background[static_cast<Eigen::Index>(channel)]);
  }
  frame.lighting.shade(seen.points, color);
  if (frame.water != nullptr && seen.water.is_needed) water_.paint(seen.water, color);
  store_colors(frame, color, column, row, picture);
}

/// Casts the rays of a tile, again from behind a surface that is seen from behind.
void CameraRenderer::see(const Frame& frame, const ViewTable::Tile& tile, bool with_look,
                         Seen& seen) const {
  constexpr int kMaxBehindOneAnother = 32;
  RayPacket& rays = seen.rays;
  rays.origin_x.fill(static_cast<float>(frame.p_world_camera.x()));
  rays.origin_y.fill(static_cast<float>(frame.p_world_camera.y()));
  rays.origin_z.fill(static_cast<float>(frame.p_world_camera.z()));
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float x = tile.x[i], y = tile.y[i];
    // The direction has length 1 along the optical axis, so that t is the depth and not the range.
    rays.direction_x[i] = frame.z_world.x() + x * frame.x_world.x() + y * frame.y_world.x();
    rays.direction_y[i] = frame.z_world.y() + x * frame.x_world.y() + y * frame.y_world.y();
    rays.direction_z[i] = frame.z_world.z() + x * frame.x_world.z() + y * frame.y_world.z();
  }
  rays.t_min.fill(static_cast<float>(spec_.near_m));
  rays.t_max.fill(static_cast<float>(spec_.far_m));
  rays.valid.fill(-1);
  // As OGRE culls them, faces are seen from their front only: rays that hit a back are cast again.
  PacketRays(frame.scene).intersect(rays, seen.hits);
  seen.points.valid.fill(0);
  for (int round = 0; round < kMaxBehindOneAnother; ++round) {
    bool is_done = true;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (rays.valid[lane] == 0) continue;
      rays.valid[lane] = describe(frame, lane, with_look, seen) ? 0 : -1;
      is_done = is_done && rays.valid[lane] == 0;
    }
    if (is_done) return;
    PacketHits again;
    PacketRays(frame.scene).intersect(rays, again);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (rays.valid[lane] == 0) continue;
      seen.hits.t[lane] = again.t[lane];
      seen.hits.shape[lane] = again.shape[lane];
      seen.hits.primitive[lane] = again.primitive[lane];
    }
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (rays.valid[lane] == 0) continue;
    seen.hits.shape[lane] = Picture::kNothing;
    seen.depths[lane] = kInfinity;
  }
}

/// Puts the water before what lies behind it, of which only as much stays as can be seen through
/// it.
void CameraRenderer::see_water(const Frame& frame, Seen& seen) const {
  const RayPacket& rays = seen.rays;
  WaterView& view = seen.water;
  view.p_world_camera = frame.p_world_camera;
  view.d_x = rays.direction_x;
  view.d_y = rays.direction_y;
  view.d_z = rays.direction_z;
  view.is_needed = false;
  const double above_m = frame.p_world_camera.z() - frame.water->highest_m();
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double behind = seen.depths[lane];
    // Most lanes end above all waves.
    const auto rising = static_cast<double>(rays.direction_z[lane]);
    if (above_m > 0.0 && (rising >= 0.0 || above_m > -rising * behind)) {
      view.water_hits[lane] = {};
      view.behind[lane] = static_cast<float>(behind);
      continue;
    }
    Ray ray;
    ray.p_world_origin = frame.p_world_camera;
    ray.direction_world = {rays.direction_x[lane], rays.direction_y[lane], rays.direction_z[lane]};
    ray.t_min_m = spec_.near_m;
    WaterHit& water_hit = view.water_hits[lane];
    water_hit = frame.water->find_hit(ray, behind);
    view.behind[lane] = static_cast<float>(behind);
    const bool is_hit = std::isfinite(water_hit.t);
    view.is_needed = view.is_needed || is_hit || water_hit.begins_below;
    if (!is_hit) continue;
    // What lies too deep, or beyond a surface that is seen from below, is not lit.
    if (behind - water_hit.t > WaterPainter::kMurk_m || water_hit.begins_below)
      seen.points.valid[lane] = 0;
    const bool is_near = water_hit.t <= spec_.far_m;
    seen.depths[lane] = is_near ? water_hit.t : kInfinity;
    seen.hits.shape[lane] = is_near ? frame.scene.surface_shape() : Picture::kNothing;
  }
}

/// Notes what a lane hits. False: that is a surface from behind, beyond which the ray begins now.
bool CameraRenderer::describe(const Frame& frame, std::size_t lane, bool with_look,
                              Seen& seen) const {
  RayPacket& rays = seen.rays;
  const std::uint32_t shape = seen.hits.shape[lane], primitive = seen.hits.primitive[lane];
  if (shape == Picture::kNothing) {
    seen.depths[lane] = kInfinity;
    return true;
  }
  const SeenSurface& surface = seen.surfaces.find(shape, primitive);
  const Eigen::Vector3d direction(rays.direction_x[lane], rays.direction_y[lane],
                                  rays.direction_z[lane]);
  double t = surface.gap_m / surface.look.normal_world.dot(direction);
  bool is_turned_away = surface.is_turned_away();
  Eigen::Vector3f normal = surface.normal_world;
  Eigen::Vector2d uv;
  if (!surface.look.is_flat || (with_look && surface.look.is_smooth)) {
    const Ray ray{frame.p_world_camera, direction, static_cast<double>(rays.t_min[lane])};
    const SurfacePoint point =
        PacketRays(frame.scene).look_at(shape, primitive, ray, seen.hits.t[lane]);
    t = point.t;
    normal = point.normal_world.cast<float>();
    const bool is_behind = point.normal_world.dot(direction) > 0.0;
    if (!surface.look.is_flat) is_turned_away = is_behind;
    if (is_behind) normal = -normal;
    uv = point.uv;
  }
  if (is_turned_away) {
    // Beyond the hit by more than a float resolves, or the same face would be hit again.
    rays.t_min[lane] = static_cast<float>(std::max(t, 0.0) * (1.0 + 2e-6) + 1e-6);
    if (!(rays.t_min[lane] <= rays.t_max[lane])) rays.t_min[lane] = rays.t_max[lane];
    return false;
  }
  if (!std::isfinite(t)) t = seen.hits.t[lane];
  seen.depths[lane] = t;
  if (!with_look) return true;
  LitPoints& points = seen.points;
  const Eigen::Vector3d p_world = frame.p_world_camera + t * direction;
  points.valid[lane] = -1;
  points.p_x[lane] = static_cast<float>(p_world.x());
  points.p_y[lane] = static_cast<float>(p_world.y());
  points.p_z[lane] = static_cast<float>(p_world.z());
  points.n_x[lane] = normal.x();
  points.n_y[lane] = normal.y();
  points.n_z[lane] = normal.z();
  set_lane(points.emissive, lane, surface.emissive);
  if (surface.look.texture == nullptr) {
    set_lane(points.ambient, lane, surface.ambient);
    set_lane(points.diffuse, lane, surface.diffuse);
    return true;
  }
  if (surface.look.is_flat) uv = surface.look.uv_slope * p_world + surface.look.uv_base;
  // What a pixel covers of a surface that it sees aslant is longer than wide; the mean of both.
  const float aslant = std::abs(normal.dot(direction.cast<float>()));
  const float width_m =
      static_cast<float>(t) * frame.pixel_angle / std::sqrt(std::max(aslant, 1e-3F));
  const Eigen::Vector3f albedo =
      surface.look.texture->at(uv.cast<float>(), width_m * surface.texels_per_meter);
  set_lane(points.ambient, lane, albedo);
  set_lane(points.diffuse, lane, albedo);
  return true;
}

void CameraRenderer::store_colors(const Frame& frame, const PacketColor& color, int column, int row,
                                  Picture& picture) const {
  PacketFloats noise{};
  if (spec_.noise.stddev > 0.0 || spec_.noise.mean != 0.0) {
    const auto tile =
        static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(table_.tile_columns()) +
        static_cast<std::uint64_t>(column);
    noise = frame.noise.normals(tile);
    const auto mean = static_cast<float>(spec_.noise.mean);
    const auto stddev = static_cast<float>(spec_.noise.stddev);
    for (float& value : noise) value = mean + stddev * value;
  }
  // As Gazebo's: one number for the channels of a pixel.
  std::array<std::array<int, kLanes>, 3> bytes;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float value = within_one(within_one(color[channel][i]) + noise[i]);
      bytes[channel][i] = static_cast<int>(value * 255.0F + kHalf);
    }
  }
  std::uint8_t* const out = picture.colors.data();
  if (spec_.format == PixelFormat::kMono8) {
    for_pixels(column, row, [&](std::size_t lane, std::size_t pixel) {
      // Luma of ITU-R BT.601.
      const int sum = 299 * bytes[0][lane] + 587 * bytes[1][lane] + 114 * bytes[2][lane];
      out[pixel] = static_cast<std::uint8_t>((sum + 500) / 1000);
    });
    return;
  }
  const std::size_t first = spec_.format == PixelFormat::kBgr8 ? 2 : 0, last = 2 - first;
  for_pixels(column, row, [&](std::size_t lane, std::size_t pixel) {
    out[3 * pixel] = static_cast<std::uint8_t>(bytes[first][lane]);
    out[3 * pixel + 1] = static_cast<std::uint8_t>(bytes[1][lane]);
    out[3 * pixel + 2] = static_cast<std::uint8_t>(bytes[last][lane]);
  });
}

}  // namespace trident::sim
