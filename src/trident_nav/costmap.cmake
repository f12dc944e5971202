# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The rooms core and costmap. One line per layer: its folder, which holds a source of the same name.
set(trident_nav_layers
  denoise_layer
  inflation_layer
  obstacle_layer
  range_sensor_layer
  static_layer
  voxel_layer
)
set(layer_sources)
set(layer_declarations)
set(layer_calls)
foreach(layer ${trident_nav_layers})
  list(APPEND layer_sources src/costmap/${layer}/${layer}.cpp)
  string(APPEND layer_declarations "void add_${layer}(Registry<LayerType>& registry);\n")
  string(APPEND layer_calls "  add_${layer}(registry);\n")
endforeach()
configure_file(src/costmap/builtin_layers.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/builtin_layers.cpp @ONLY)

add_library(trident_nav_costmap
  src/costmap/beams/beam_layer.cpp
  src/costmap/beams/beam_source.cpp
  src/costmap/block_set.cpp
  src/costmap/config/costmap_config.cpp
  src/costmap/costmap.cpp
  src/costmap/costmap_params.cpp
  src/costmap/distance_tracker.cpp
  src/costmap/layer_factory.cpp
  src/costmap/layer_stack.cpp
  src/costmap/observation.cpp
  src/costmap/source_age.cpp
  src/costmap/square_kernel.cpp
  ${layer_sources}
  ${CMAKE_CURRENT_BINARY_DIR}/builtin_layers.cpp
)
target_compile_features(trident_nav_costmap PUBLIC cxx_std_17)
target_compile_options(trident_nav_costmap PRIVATE -Wall -Wextra -ffp-contract=off)
target_include_directories(trident_nav_costmap PUBLIC include PRIVATE src)
target_link_libraries(trident_nav_costmap PUBLIC trident_nav_core)
trident_precompile_headers(trident_nav_costmap)
install(TARGETS trident_nav_costmap
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
)

# Prints the median times of what docs/reference/benchmarks.md lists.
add_executable(trident_nav_costmap_bench benchmark/costmap/costmap_bench.cpp)
target_link_libraries(trident_nav_costmap_bench trident_nav_costmap)

if(CATKIN_ENABLE_TESTING)
  catkin_add_gtest(trident_nav_core_test
    test/core/cost_grid_test.cpp
    test/core/path_cusps_test.cpp
    test/core/footprint_test.cpp
    test/core/shape_cells_test.cpp
  )
  target_link_libraries(trident_nav_core_test trident_nav_costmap gtest_main)
  catkin_add_gtest(trident_nav_costmap_test
    test/costmap/block_set_test.cpp
    test/costmap/costmap_config_test.cpp
    test/costmap/costmap_test.cpp
    test/costmap/denoise_layer_test.cpp
    test/costmap/distance_tracker_test.cpp
    test/costmap/footprint_checker_test.cpp
    test/costmap/inflation_layer_test.cpp
    test/costmap/layer_conformance_test.cpp
    test/costmap/observation_test.cpp
    test/costmap/obstacle_layer_test.cpp
    test/costmap/range_sensor_layer_test.cpp
    test/costmap/source_age_test.cpp
    test/costmap/static_layer_test.cpp
    test/costmap/voxel_layer_test.cpp
  )
  target_include_directories(trident_nav_costmap_test PRIVATE src test)
  target_link_libraries(trident_nav_costmap_test trident_nav_costmap gtest_main)
endif()
