# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room of the planners. A new planner is a header, a source that registers it, and a line here.
set(trident_nav_planners
  grids/carrot_planner
  grids/global_planner
  grids/navfn_planner
  grids/smac_2d_planner
  poses/robot_planner
  poses/smac_hybrid_planner
  poses/smac_lattice_planner
  grids/theta_star_planner
)
set(trident_nav_planning_sources
  src/planning/curves/curve_checker.cpp
  src/planning/curves/footprint_contact.cpp
  src/planning/poses/goal_probe.cpp
  src/planning/potential/detours.cpp
  src/planning/grids/grid_route.cpp
  src/planning/grids/jump_points.cpp
  src/planning/grids/jump_scan.cpp
  src/planning/curves/lattice_file.cpp
  src/planning/curves/lattice_set.cpp
  src/planning/grids/line_cost.cpp
  src/planning/curves/motion_curve.cpp
  src/planning/curves/motion_set.cpp
  src/planning/poses/obstacle_heuristic.cpp
  src/planning/grids/path_points.cpp
  src/planning/curves/path_shortcuts.cpp
  src/planning/plan_request.cpp
  src/planning/planner_registry.cpp
  src/planning/poses/pose_route.cpp
  src/planning/poses/pose_route_search.cpp
  src/planning/poses/pose_search.cpp
  src/planning/potential/potential.cpp
  src/planning/potential/potential_cells.cpp
  src/planning/potential/potential_repair.cpp
  src/planning/potential/start_search.cpp
  src/planning/poses/slot_exit.cpp
  src/planning/poses/smac_options.cpp
  src/planning/grids/theta_search.cpp
)
set(declarations)
set(calls)
foreach(source ${trident_nav_planners})
  get_filename_component(planner ${source} NAME)
  list(APPEND trident_nav_planning_sources src/planning/${source}.cpp)
  string(APPEND declarations "void add_${planner}(Registry<PlannerFactory>& registry);\n")
  string(APPEND calls "  add_${planner}(registry);\n")
endforeach()
configure_file(src/planning/builtin_planners.cpp.in
               ${CMAKE_CURRENT_BINARY_DIR}/builtin_planners.cpp @ONLY)
list(APPEND trident_nav_planning_sources ${CMAKE_CURRENT_BINARY_DIR}/builtin_planners.cpp)

add_library(trident_nav_planning ${trident_nav_planning_sources})
target_compile_features(trident_nav_planning PUBLIC cxx_std_17)
# Functions of one file may call each other directly, as they do where the library is linked in.
target_compile_options(trident_nav_planning PRIVATE -Wall -Wextra -ffp-contract=off
                       -fno-semantic-interposition)
target_include_directories(trident_nav_planning PUBLIC include PRIVATE src)
target_link_libraries(trident_nav_planning PUBLIC trident_nav_core trident_base trident_maps)
trident_precompile_headers(trident_nav_planning)
install(TARGETS trident_nav_planning
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
)

# --- benchmark programs -------------------------------------------------------------------------
add_executable(nav_planning_bench benchmark/planning_bench.cpp benchmark/bench_maps.cpp)
add_executable(nav_movingai_bench benchmark/movingai_bench.cpp benchmark/bench_maps.cpp)
add_executable(nav_replan_bench benchmark/replan_bench.cpp benchmark/bench_maps.cpp)
foreach(program nav_planning_bench nav_movingai_bench nav_replan_bench)
  target_include_directories(${program} PRIVATE src benchmark)
  target_link_libraries(${program} trident_nav_planning)
  set_target_properties(${program} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS ${program} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()

# --- programs behind `./trident plan` and `./trident lattice` -----------------------------------
add_executable(nav_plan programs/nav_plan.cpp)
target_link_libraries(nav_plan trident_nav_planning trident_nav_costmap trident_nav_control trident_maps)
add_executable(nav_lattice programs/nav_lattice.cpp)
target_include_directories(nav_lattice PRIVATE src)
target_link_libraries(nav_lattice trident_nav_planning)
foreach(program nav_plan nav_lattice)
  set_target_properties(${program} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS ${program} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()

if(CATKIN_ENABLE_TESTING)
  catkin_add_gtest(trident_nav_planning_test
    test/planning/footprint_contact_test.cpp
    test/planning/grid_planners_test.cpp
    test/planning/jump_points_test.cpp
    test/planning/lattice_set_test.cpp
    test/planning/line_cost_test.cpp
    test/planning/motion_curve_test.cpp
    test/planning/movingai_test.cpp
    test/planning/planner_conformance_test.cpp
    test/planning/potential_test.cpp
    test/planning/reference_search.cpp
    test/planning/robot_planner_test.cpp
    test/planning/replan_test.cpp
    test/planning/smac_planners_test.cpp
    test/planning/start_search_test.cpp
    benchmark/bench_maps.cpp
  )
  target_include_directories(trident_nav_planning_test PRIVATE test src benchmark)
  target_link_libraries(trident_nav_planning_test trident_nav_planning gtest_main)
  # Lengths of curves are compared with OMPL's where that is installed.
  find_package(ompl QUIET)
  if(OMPL_FOUND)
    target_compile_definitions(trident_nav_planning_test PRIVATE TRIDENT_TEST_OMPL)
    target_include_directories(trident_nav_planning_test SYSTEM PRIVATE ${OMPL_INCLUDE_DIRS})
    target_link_libraries(trident_nav_planning_test ${OMPL_LIBRARIES})
  endif()
  trident_precompile_headers(trident_nav_planning_test <gtest/gtest.h>)
endif()
