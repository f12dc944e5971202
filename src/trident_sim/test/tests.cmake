# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# Fixtures, models and the conformance suite of plugins, for the tests of this package and of others.
add_library(trident_sim_test_support STATIC
  test_support/car.cpp
  test_support/cart.cpp
  test_support/golden_data.cpp
  test_support/lidar_rig.cpp
  test_support/lee_quad.cpp
  test_support/models.cpp
  test_support/plugin_cases.cpp
  test_support/plugin_conformance.cpp
  test_support/quad_world.cpp
  test_support/test_world.cpp
)
target_include_directories(trident_sim_test_support PUBLIC test_support ${GTEST_INCLUDE_DIRS})
target_compile_definitions(trident_sim_test_support PUBLIC TRIDENT_REPOSITORY="${CMAKE_SOURCE_DIR}")
target_compile_options(trident_sim_test_support PRIVATE -Wall -Wextra)
target_link_libraries(trident_sim_test_support PUBLIC trident_sim)

catkin_add_gtest(trident_sim_test
  test/broadphase_test.cpp
  test/bumper_test.cpp
  test/command_timing_test.cpp
  test/contact_correction_test.cpp
  test/contact_test.cpp
  test/determinism_test.cpp
  test/free_body_test.cpp
  test/friction_test.cpp
  test/gazebo_imu_test.cpp
  test/geoid_grid_test.cpp
  test/gnss_test.cpp
  test/hector_sensors_test.cpp
  test/imu_statistics_test.cpp
  test/imu_test.cpp
  test/inertia_test.cpp
  test/joint_test.cpp
  test/lidar_spec_test.cpp
  test/lockstep_test.cpp
  test/motor_model_test.cpp
  test/navigation_sensors_test.cpp
  test/odd_elements_test.cpp
  test/ode_stepper_test.cpp
  test/odometry_test.cpp
  test/ogre_script_test.cpp
  test/plugin_conformance_test.cpp
  test/port_test.cpp
  test/reset_test.cpp
  test/resources_test.cpp
  test/rotor_axis_test.cpp
  test/run_time_changes_test.cpp
  test/sample_clock_test.cpp
  test/sdf_error_test.cpp
  test/sdf_frames_test.cpp
  test/sdf_look_test.cpp
  test/sdf_schema_test.cpp
  test/sdf_sources_test.cpp
  test/sdf_world_test.cpp
  test/setpoint_sources_test.cpp
  test/urdf_test.cpp
  test/wind_field_file_test.cpp
  test/wind_field_plugin_test.cpp
  test/wind_field_test.cpp
  test/wind_test.cpp
  test/world_lifecycle_test.cpp
  test/world_state_test.cpp
)
target_link_libraries(trident_sim_test
  trident_sim_test_support sdformat12::sdformat12 PkgConfig::GEOGRAPHICLIB ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_test PRIVATE src)  # parts of plugins
trident_precompile_headers(trident_sim_test <gtest/gtest.h>)

# Joints, terrain, contacts against closed forms, snapshots of flights.
catkin_add_gtest(trident_sim_physics_test
  test/contact_closed_form_test.cpp
  test/coupled_joint_test.cpp
  test/heightmap_test.cpp
  test/joint_drive_test.cpp
  test/joint_types_test.cpp
  test/rigid_cases_test.cpp
  test/sdf_joint_test.cpp
  test/snapshot_test.cpp
  test/solver_options_test.cpp
  test_support/golden_world.cpp
)
target_link_libraries(trident_sim_physics_test
  trident_sim_test_support trident_control_sim PkgConfig::PNG ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_physics_test PRIVATE src)  # parts of the core

# Ground robots on their wheels.
catkin_add_gtest(trident_sim_ground_test
  test/ackermann_drive_test.cpp
  test/diagnostics_test.cpp
  test/drive_plugins_test.cpp
  test/ground_closed_form_test.cpp
  test/ground_drive_test.cpp
)
target_link_libraries(trident_sim_ground_test trident_sim_test_support ${GTEST_MAIN_LIBRARIES})

# Closed loops, with the Lee controller as a plugin (trident_control_sim is defined later on).
catkin_add_gtest(trident_sim_flight_test
  test/closed_loop_test.cpp
  test/golden_flight_test.cpp
  test/golden_replay_test.cpp
  test/golden_rigid_test.cpp
  test_support/golden_world.cpp
)
target_link_libraries(trident_sim_flight_test
  trident_sim_test_support trident_control_sim ${GTEST_MAIN_LIBRARIES})

# Alone, because it replaces malloc.
catkin_add_gtest(trident_sim_allocation_test test/allocation_test.cpp)
target_link_libraries(trident_sim_allocation_test
  trident_base_test_support trident_sim_test_support trident_control_sim ${GTEST_MAIN_LIBRARIES})

# Alone: libsdformat's messages about damaged input fill pages, and a crash must not hide other tests.
catkin_add_gtest(trident_sim_mutated_input_test test/mutated_input_test.cpp)
target_link_libraries(trident_sim_mutated_input_test trident_sim_test_support ${GTEST_MAIN_LIBRARIES})

# Cameras.
catkin_add_gtest(trident_sim_cameras_test
  test/camera_control_test.cpp
  test/camera_light_test.cpp
  test/camera_model_test.cpp
  test/camera_picture_test.cpp
  test/camera_plugins_test.cpp
  test/depth_camera_test.cpp
  test/image_codec_test.cpp
  test/segmentation_camera_test.cpp
  test/water/water_camera_test.cpp
)
target_link_libraries(trident_sim_cameras_test
  trident_sim_test_support PkgConfig::PNG ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_cameras_test PRIVATE src)  # parts of the core

# Ray casting.
catkin_add_gtest(trident_sim_rays_test
  test/laser_scanner_test.cpp
  test/lidar_pattern_test.cpp
  test/mesh_test.cpp
  test/picture_file_test.cpp
  test/point_lidar_test.cpp
  test/ray_brute_force_test.cpp
  test/ray_look_test.cpp
  test/ray_scene_test.cpp
  test/ray_shape_test.cpp
  test/follow_test.cpp
  test/small_sensors_test.cpp
  test/water/water_lidar_test.cpp
  test/water/water_surface_test.cpp
)
target_link_libraries(trident_sim_rays_test
  trident_sim_test_support PkgConfig::JPEG PkgConfig::PNG ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_rays_test PRIVATE src)  # parts of the core
# Once more with the kernels of processors without AVX-512, whose packets are half as wide as ours.
add_test(NAME trident_sim_rays_avx2 COMMAND trident_sim_rays_test)
set_tests_properties(trident_sim_rays_avx2 PROPERTIES ENVIRONMENT TRIDENT_EMBREE=isa=avx2 TIMEOUT 300)

# Vessels and the sea.
catkin_add_gtest(trident_sim_marine_test
  test/marine/current_test.cpp
  test/marine/hull_test.cpp
  test/marine/live_environment_test.cpp
  test/marine/mooring_test.cpp
  test/marine/sea_plugin_test.cpp
  test/marine/seabed_test.cpp
  test/marine/standalone_vessel.cpp
  test/marine/thruster_test.cpp
  test/marine/usv_plugins_test.cpp
  test/marine/uuv_plugins_test.cpp
  test/marine/vessel_dynamics_test.cpp
  test/marine/vessel_matrices_test.cpp
  test/marine/vessel_params_test.cpp
  test/marine/vessel_plugin_test.cpp
  test/marine/wave_field_test.cpp
  test/marine/wind_gusts_test.cpp
  test/marine/wind_on_vehicles_test.cpp
)
target_link_libraries(trident_sim_marine_test trident_sim_test_support ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_marine_test PRIVATE src)  # parts of the core

# Vessels under their controllers (trident_control_sim is defined later on).
catkin_add_gtest(trident_sim_vessel_control_test
  test/marine/standalone_vessel.cpp
  test/marine/vessel_control_test.cpp
  test/marine/vessel_controller_plugin_test.cpp
  test/marine/vessel_drift_test.cpp
)
target_link_libraries(trident_sim_vessel_control_test
  trident_sim_test_support trident_control_sim ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_vessel_control_test PRIVATE src)  # parts of the core

# A boat alone on a manoeuvre, for comparisons with other integrators.
add_executable(vessel_manoeuvre test/marine/standalone_vessel.cpp test/marine/vessel_manoeuvre.cpp)
target_compile_options(vessel_manoeuvre PRIVATE -Wall -Wextra)
target_include_directories(vessel_manoeuvre PRIVATE src)
target_link_libraries(vessel_manoeuvre PRIVATE trident_sim_test_support)

# What plugins ask of their elements, for docs/reference/plugins.md.
add_executable(plugin_reference test/plugin_reference.cpp test/plugin_reference_cases.cpp)
target_compile_options(plugin_reference PRIVATE -Wall -Wextra)
target_link_libraries(plugin_reference PRIVATE trident_sim_test_support trident_control_sim)

# One set of precompiled headers for all of them.
foreach(test trident_sim_physics_test trident_sim_ground_test trident_sim_flight_test trident_sim_allocation_test
             trident_sim_mutated_input_test trident_sim_cameras_test trident_sim_rays_test
             trident_sim_marine_test trident_sim_vessel_control_test)
  target_precompile_headers(${test} REUSE_FROM trident_sim_test)
endforeach()
