// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/mesh.h"

#include <gtest/gtest.h>

#include "ray_check.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

/// One triangle (0 0 0), (1 0 0), (0 0 2) of a red material, in a COLLADA file.
std::string collada(const std::string& up_axis) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="meter"/><up_axis>)" +
         up_axis + R"(</up_axis></asset>
<library_effects><effect id="red"><profile_COMMON><technique sid="common"><lambert>
<diffuse><color>0.8 0.1 0.2 1</color></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="paint"><instance_effect url="#red"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 0 2</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="m" target="#paint"/></technique_common>
</bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

TEST(Mesh, TheUpAxisOfAColladaFileDoesNotTurnIt) {
  const ScratchFolder folder;
  for (const char* up_axis : {"X_UP", "Y_UP", "Z_UP"}) {
    const std::string file = folder.write(std::string(up_axis) + ".dae", collada(up_axis));
    const TriangleMesh mesh = read_mesh({file, {1, 1, 3}}, MeshDetail::kShape);
    ASSERT_EQ(mesh.vertex_count(), 3u);
    double highest = 0.0;
    for (std::size_t v = 0; v < 3; ++v) {
      highest = std::max<double>(highest, mesh.vertices[3 * v + 2]);
      EXPECT_EQ(mesh.vertices[3 * v + 1], 0.0F) << up_axis;
    }
    EXPECT_FLOAT_EQ(highest, 6.0) << up_axis;
    EXPECT_TRUE(mesh.materials.empty());
  }
}

TEST(Mesh, MaterialsAreReadOnlyForLooking) {
  const ScratchFolder folder;
  const std::string file = folder.write("a.dae", collada("Z_UP"));
  const TriangleMesh mesh = read_mesh({file, {1, 1, 1}}, MeshDetail::kLook);
  ASSERT_EQ(mesh.triangle_materials.size(), 1u);
  const Eigen::Vector4d diffuse = mesh.materials.at(mesh.triangle_materials[0]).diffuse;
  EXPECT_NEAR((diffuse - Eigen::Vector4d(0.8, 0.1, 0.2, 1.0)).norm(), 0.0, 1e-6);
}

TEST(Mesh, WhatCannotBeReadIsNamed) {
  const ScratchFolder folder;
  const std::string empty = folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  for (const std::string& file : {std::string("/nowhere/a.stl"), empty}) {
    const std::string error = error_of([&] { read_mesh({file, {1, 1, 1}}, MeshDetail::kShape); });
    EXPECT_TRUE(contains(error, "mesh '" + file + "'"));
  }
}

TEST(Mesh, AHeightmapTooLargeForTrianglesIsLeftOutOfWhatRaysSee) {
  const ScratchFolder folder;
  const std::string file =
      folder.write("large.pgm", "P5\n2050 2050\n255\n" + std::string(2050 * 2050, 'x'));
  TestWorld world;
  world.add(make_visual("hills", HeightmapShape{file, {10, 10, 1}}, {}));
  const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  EXPECT_TRUE(scene.shapes().empty());
  EXPECT_EQ(world.report_count(Severity::kWarning, "'hills::link::visual': heightmap '" + file +
                                                       "' has 2050 x 2050 samples"),
            1u);
}

}  // namespace
}  // namespace trident::sim
