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
target_link_libraries(trident_sim_test_support PUBLIC trident_sim gtest)

# A new sensor's test needs no line here. What follows is with the ray casting tests below.
file(GLOB sensor_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/test/sensors/*_test.cpp)
list(FILTER sensor_tests EXCLUDE REGEX "/(laser_scanner|lidar_pattern|point_lidar|small_sensors)_test\\.cpp$")
catkin_add_gtest(trident_sim_test
  ${sensor_tests}
  test/physics/broadphase_test.cpp
  test/flight/command_timing_test.cpp
  test/physics/contact_correction_test.cpp
  test/physics/contact_test.cpp
  test/flight/determinism_test.cpp
  test/physics/free_body_test.cpp
  test/physics/friction_test.cpp
  test/physics/inertia_test.cpp
  test/physics/joint_test.cpp
  test/world/lockstep_test.cpp
  test/vehicles/battery_test.cpp
  test/vehicles/motor_model_test.cpp
  test/sdf/odd_elements_test.cpp
  test/physics/ode_stepper_test.cpp
  test/vehicles/odometry_test.cpp
  test/sdf/ogre_script_test.cpp
  test/world/plugin_conformance_test.cpp
  test/world/port_test.cpp
  test/world/reset_test.cpp
  test/sdf/resources_test.cpp
  test/vehicles/rotor_axis_test.cpp
  test/physics/run_time_changes_test.cpp
  test/sdf/sdf_error_test.cpp
  test/sdf/sdf_frames_test.cpp
  test/sdf/sdf_look_test.cpp
  test/sdf/sdf_schema_test.cpp
  test/sdf/sdf_sources_test.cpp
  test/sdf/sdf_world_test.cpp
  test/flight/setpoint_sources_test.cpp
  test/sdf/urdf_test.cpp
  test/vehicles/wind_field_file_test.cpp
  test/vehicles/wind_field_plugin_test.cpp
  test/vehicles/wind_field_test.cpp
  test/vehicles/wind_test.cpp
  test/world/world_lifecycle_test.cpp
  test/world/world_state_test.cpp
)
target_link_libraries(trident_sim_test
  trident_sim_test_support sdformat12::sdformat12 PkgConfig::ODE PkgConfig::GEOGRAPHICLIB PkgConfig::TINYXML2 ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_test PRIVATE src)  # parts of plugins
trident_precompile_headers(trident_sim_test <gtest/gtest.h>)

# Joints, terrain, contacts against closed forms, snapshots of flights.
catkin_add_gtest(trident_sim_physics_test
  test/physics/contact_closed_form_test.cpp
  test/physics/coupled_joint_test.cpp
  test/physics/heightmap_test.cpp
  test/physics/joint_drive_test.cpp
  test/physics/joint_types_test.cpp
  test/physics/rigid_cases_test.cpp
  test/sdf/sdf_joint_test.cpp
  test/world/snapshot_test.cpp
  test/physics/solver_options_test.cpp
  test_support/golden_world.cpp
)
target_link_libraries(trident_sim_physics_test
  trident_sim_test_support trident_control_sim PkgConfig::PNG ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_physics_test PRIVATE src)  # parts of the core

# Ground robots on their wheels.
catkin_add_gtest(trident_sim_ground_test
  test/vehicles/ackermann_drive_test.cpp
  test/world/diagnostics_test.cpp
  test/vehicles/drive_plugins_test.cpp
  test/vehicles/ground_closed_form_test.cpp
  test/vehicles/ground_drive_test.cpp
)
target_link_libraries(trident_sim_ground_test trident_sim_test_support ${GTEST_MAIN_LIBRARIES})

# Closed loops, with the Lee controller as a plugin (trident_control_sim is defined later on).
catkin_add_gtest(trident_sim_flight_test
  test/flight/closed_loop_test.cpp
  test/flight/golden_flight_test.cpp
  test/flight/golden_replay_test.cpp
  test/flight/golden_rigid_test.cpp
  test_support/golden_world.cpp
)
target_link_libraries(trident_sim_flight_test
  trident_sim_test_support trident_control_sim ${GTEST_MAIN_LIBRARIES})

# Alone, because it replaces malloc.
catkin_add_gtest(trident_sim_allocation_test test/flight/allocation_test.cpp)
target_link_libraries(trident_sim_allocation_test
  trident_base_test_support trident_sim_test_support trident_control_sim ${GTEST_MAIN_LIBRARIES})

# Alone: libsdformat's messages about damaged input fill pages, and a crash must not hide other tests.
catkin_add_gtest(trident_sim_mutated_input_test test/sdf/mutated_input_test.cpp)
target_link_libraries(trident_sim_mutated_input_test trident_sim_test_support ${GTEST_MAIN_LIBRARIES})

# Cameras.
catkin_add_gtest(trident_sim_cameras_test
  test/cameras/camera_control_test.cpp
  test/cameras/camera_light_test.cpp
  test/cameras/camera_model_test.cpp
  test/cameras/camera_picture_test.cpp
  test/cameras/camera_plugins_test.cpp
  test/cameras/depth_camera_test.cpp
  test/cameras/image_codec_test.cpp
  test/cameras/segmentation_camera_test.cpp
  test/water/water_camera_test.cpp
)
target_link_libraries(trident_sim_cameras_test
  trident_sim_test_support PkgConfig::PNG ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_cameras_test PRIVATE src)  # parts of the core

# Ray casting.
catkin_add_gtest(trident_sim_rays_test
  test/sensors/laser_scanner_test.cpp
  test/sensors/lidar_pattern_test.cpp
  test/rays/mesh_test.cpp
  test/rays/picture_file_test.cpp
  test/sensors/point_lidar_test.cpp
  test/rays/ray_brute_force_test.cpp
  test/rays/ray_look_test.cpp
  test/rays/ray_scene_test.cpp
  test/rays/ray_shape_test.cpp
  test/vehicles/follow_test.cpp
  test/sensors/small_sensors_test.cpp
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
  test/marine/buoyancy_test.cpp
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

# Radios.
catkin_add_gtest(trident_sim_comms_test
  test/comms/radio_channel_test.cpp
  test/comms/radio_physics_test.cpp
  test/comms/radio_plugins_test.cpp
  test/comms/relay_calls_test.cpp
  test/comms/relay_counts_test.cpp
  test/comms/relay_latched_test.cpp
  test/comms/relay_ports_test.cpp
  test/comms/relay_rules_test.cpp
  test/comms/relay_test.cpp
  test/comms/routing_mesh.cpp
  test/comms/routing_repair_test.cpp
  test/comms/routing_test.cpp
)
target_link_libraries(trident_sim_comms_test trident_sim_test_support ${GTEST_MAIN_LIBRARIES})
target_include_directories(trident_sim_comms_test PRIVATE src)  # parts of the core

# Vessels under their controllers (trident_control_sim is defined later on).
catkin_add_gtest(trident_sim_vessel_control_test
  test/marine/standalone_vessel.cpp
  test/marine/control/vessel_control_test.cpp
  test/marine/control/vessel_controller_plugin_test.cpp
  test/marine/control/vessel_drift_test.cpp
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
target_link_libraries(plugin_reference PRIVATE trident_sim_test_support trident_bridges_sim trident_control_sim)

# One set of precompiled headers for all of them.
foreach(test trident_sim_physics_test trident_sim_ground_test trident_sim_flight_test trident_sim_allocation_test
             trident_sim_mutated_input_test trident_sim_cameras_test trident_sim_rays_test
             trident_sim_comms_test trident_sim_marine_test trident_sim_vessel_control_test)
  target_precompile_headers(${test} REUSE_FROM trident_sim_test)
endforeach()
