// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "camera_spec.h"
#include "lighting.h"
#include "view_table.h"
#include "water_painter.h"

namespace trident::sim {

/// What a camera sees, pixel by pixel in rows from the top. Lists that are not wanted are left
/// alone.
struct Picture {
  static constexpr std::uint32_t kNothing = RayHit::kNothing;

  bool wants_colors = false, wants_depths = false, wants_shapes = false;
  std::vector<std::uint8_t> colors;   ///< as the format of the camera says
  std::vector<float> depths;          ///< along the axis [m]; infinite: nothing
  std::vector<std::uint32_t> shapes;  ///< indices into RayScene::shapes(), or kNothing
};

/// Draws the visuals of a world through a pinhole: one ray per pixel, one to each lamp that casts
/// shadows. Surfaces are seen from their front only, as in Gazebo: a camera looks out of its own
/// housing. The sea, where the world has one, is seen to the horizon, however near `far_m` is;
/// depths and shapes end there. Pictures are equal to the bit whatever else is drawn with them.
class CameraRenderer {
 public:
  /// Throws Error that begins with `owner`, see ViewTable. `world` must outlive this.
  CameraRenderer(World& world, const CameraSpec& spec, const CameraModel& model,
                 const std::string& owner);
  ~CameraRenderer();
  CameraRenderer(const CameraRenderer&) = delete;
  CameraRenderer& operator=(const CameraRenderer&) = delete;

  /// `T_world_camera`: x ahead, z up. `noise_key`: random bits of this picture's own.
  void render(const SE3& T_world_camera, std::uint64_t noise_key, Picture& picture);
  const ViewTable& table() const { return table_; }

 private:
  struct Frame;
  struct Seen;
  void make_room(Picture& picture) const;
  void render_tile(const Frame& frame, int column, int row, Seen& seen, Picture& picture) const;
  void see(const Frame& frame, const ViewTable::Tile& tile, bool with_look, Seen& seen) const;
  bool describe(const Frame& frame, std::size_t lane, bool with_look, Seen& seen) const;
  void see_water(const Frame& frame, Seen& seen) const;
  void store_colors(const Frame& frame, const PacketColor& color, int column, int row,
                    Picture& picture) const;
  template <class Store>
  void for_pixels(int column, int row, Store&& store) const;

  World& world_;
  CameraSpec spec_;
  int width_, height_;
  float pixel_angle_;
  ViewTable table_;
  WaterPainter water_;
  std::vector<std::unique_ptr<Seen>> seen_;  ///< by worker
};

}  // namespace trident::sim
