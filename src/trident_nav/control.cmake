# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room `control`: controllers, without ROS.
add_library(trident_nav_control
  src/control/braking_guard.cpp
  src/control/builtin_laws.cpp
  src/control/config_split.cpp
  src/control/dwa/dwa_law.cpp
  src/control/dwa/map_grid.cpp
  src/control/dwa/trajectory_critics.cpp
  src/control/dwa/trajectory_search.cpp
  src/control/dwa/velocity_samples.cpp
  src/control/dwb/dwb_critics.cpp
  src/control/dwb/dwb_law.cpp
  src/control/escape.cpp
  src/control/goal_arrival.cpp
  src/control/graceful/graceful_law.cpp
  src/control/graceful/smooth_law.cpp
  src/control/guarded_controller.cpp
  src/control/last_command.cpp
  src/control/maneuver_follower.cpp
  src/control/motion.cpp
  src/control/mppi/control_plan.cpp
  src/control/mppi/critics/critic.cpp
  src/control/mppi/critics/critic_scene.cpp
  src/control/mppi/critics/goal_critics.cpp
  src/control/mppi/critics/motion_critics.cpp
  src/control/mppi/critics/obstacle_critics.cpp
  src/control/mppi/critics/path_critics.cpp
  src/control/mppi/critics/track_critic.cpp
  src/control/mppi/deliberate_samples.cpp
  src/control/mppi/lanes.cpp
  src/control/mppi/mppi_law.cpp
  src/control/mppi/mppi_model.cpp
  src/control/mppi/mppi_optimizer.cpp
  src/control/mppi/noise_table.cpp
  src/control/mppi/obstacle_survey.cpp
  src/control/mppi/path_centering.cpp
  src/control/mppi/rollout.cpp
  src/control/mppi/vessel_motion.cpp
  src/control/path_tracker.cpp
  src/control/progress_monitor.cpp
  src/control/pure_pursuit/pure_pursuit_law.cpp
  src/control/robot_state.cpp
  src/control/rotation_shim/rotation_shim_law.cpp
  src/control/steering.cpp
  src/control/teb/footprint_distance.cpp
  src/control/teb/homotopy_map.cpp
  src/control/teb/homotopy_search.cpp
  src/control/teb/normal_equations.cpp
  src/control/teb/teb_band.cpp
  src/control/teb/teb_guide.cpp
  src/control/teb/teb_law.cpp
  src/control/teb/teb_obstacles.cpp
  src/control/teb/teb_optimizer.cpp
  src/control/teb/teb_planner.cpp
  src/control/teb/teb_problem.cpp
  src/control/teb/teb_terms.cpp
  src/control/tracking/moving_obstacles.cpp
  src/control/tracking/obstacle_tracker.cpp
  src/control/tracking/reported_obstacle.cpp
  src/control/tracking/scan_clusters.cpp
  src/control/trajectory_planner/dead_end_escape.cpp
  src/control/trajectory_planner/trajectory_planner_law.cpp
)
target_compile_features(trident_nav_control PUBLIC cxx_std_17)
target_compile_options(trident_nav_control PRIVATE -Wall -Wextra -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_include_directories(trident_nav_control PUBLIC include)
target_link_libraries(trident_nav_control PUBLIC trident_nav_core trident_maps PRIVATE trident_control)
trident_precompile_headers(trident_nav_control)
# Loops over lanes: turned into vector instructions, which keep the value of every operation.
set_source_files_properties(
  src/control/mppi/critics/critic.cpp
  src/control/mppi/critics/goal_critics.cpp
  src/control/mppi/critics/motion_critics.cpp
  src/control/mppi/critics/obstacle_critics.cpp
  src/control/mppi/critics/path_critics.cpp
  src/control/mppi/critics/track_critic.cpp
  src/control/mppi/mppi_optimizer.cpp
  src/control/mppi/obstacle_survey.cpp
  src/control/mppi/rollout.cpp
  PROPERTIES COMPILE_OPTIONS -O3 SKIP_UNITY_BUILD_INCLUSION ON)
install(TARGETS trident_nav_control
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
)

if(CATKIN_ENABLE_TESTING)
  catkin_add_gtest(trident_nav_control_test
    test/control/grid_world.cpp
    test/control/arrival_test.cpp
    test/control/control_details_test.cpp
    test/control/controller_conformance_test.cpp
    test/control/laws_test.cpp
    test/control/maneuver_test.cpp
    test/control/moving_obstacles_test.cpp
    test/control/mppi_test.cpp
    test/control/path_centering_test.cpp
    test/control/scene.cpp
    test/control/scenes_test.cpp
    test/control/teb_scenes_test.cpp
    test/control/teb_test.cpp
    test/control/tracking_test.cpp
    test/control/vessel_motion_test.cpp
  )
  target_include_directories(trident_nav_control_test PRIVATE test src)
  target_compile_definitions(trident_nav_control_test PRIVATE
    TRIDENT_VESSELS="${CMAKE_CURRENT_SOURCE_DIR}/../../config/vessels/")
  target_link_libraries(trident_nav_control_test trident_nav_control gtest_main)
  trident_precompile_headers(trident_nav_control_test <gtest/gtest.h>)
endif()

# --- benchmark program --------------------------------------------------------------------------
add_executable(control_bench benchmark/control_bench.cpp test/control/grid_world.cpp test/control/scene.cpp)
target_include_directories(control_bench PRIVATE test)
target_compile_options(control_bench PRIVATE -Wall -Wextra)
target_link_libraries(control_bench trident_nav_control)
set_target_properties(control_bench PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
