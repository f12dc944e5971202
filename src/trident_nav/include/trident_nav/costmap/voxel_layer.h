// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_nav/costmap/beam_layer.h"

namespace trident::nav {

struct VoxelLayerParams : BeamLayerParams {
  double origin_z = 0.0;
  double z_resolution = 0.2;
  int z_voxels = 10;
  int unknown_threshold = 15;
  int mark_threshold = 0;
  bool publish_voxel_map = false;

  template <class Archive>
  void visit(Archive& ar) {
    BeamLayerParams::visit(ar);
    ar.field("origin_z", origin_z, "height of the lowest voxels' lower side [m]");
    ar.field("z_resolution", z_resolution, Range::positive(), "height of a voxel [m]");
    ar.field("z_voxels", z_voxels, Range{1, 16}, "voxels of a column");
    ar.field("unknown_threshold", unknown_threshold, Range{0, 16},
             "a column with no mark is free with up to this many unknown voxels, not counting "
             "those above z_voxels");
    ar.field("mark_threshold", mark_threshold, Range{0, 16},
             "a column with more marked voxels than this is an obstacle");
    ar.field("publish_voxel_map", publish_voxel_map, "the voxels are published");
  }
};

/// Obstacles as voxels, up to 16 above each cell: a beam clears those that it passes, and an
/// obstacle that it passes above stays.
class VoxelLayer : public BeamLayer {
 public:
  using Params = VoxelLayerParams;

  explicit VoxelLayer(const LayerSetup& setup);

  const Params& params() const { return params_; }
  void set_params(const Params& params);

  /// One column a cell, rows without gaps, in the bits of costmap_2d/VoxelGrid: of voxel z, counted
  /// from below, bits z and 16 + z are 1, 1 when it is marked, 1, 0 unknown, 0, 0 free.
  const std::vector<std::uint32_t>& columns() const { return columns_.cells(); }

  void resize(const GridGeometry& geometry) override;

 private:
  void clear_beams(const Observation& observation, const Reach& reach) override;
  void mark_ends(const Observation& observation, const Reach& reach, double now_s) override;
  void keep_cell(std::size_t cell) override;
  void restore_cell(std::size_t cell, std::size_t index, double now_s) override;
  void forget_cells(int y, int x0, int x1) override;
  void free_cells(int y, int x0, int x1) override;

  struct Beam;
  Beam beam_to(const BeamGroup& group, const BeamEnd& end, const Reach& reach) const;
  bool is_new_end(const Beam& beam);
  void clear_beam(const Beam& beam);
  void clear_voxels(std::size_t cell, std::uint32_t levels);
  void mark_voxel(std::size_t cell, int level, double now_s);

  Params params_;
  int unknown_threshold_;  // counting the voxels that no column has
  LayerGrid<std::uint32_t> columns_;
  std::vector<std::uint32_t> ends_;  // by cell: voxels where a beam of the group has ended
  std::vector<std::size_t> ended_;   // cells with ends_
  std::vector<std::uint32_t> kept_columns_;
};

}  // namespace trident::nav
