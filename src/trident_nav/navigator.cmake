# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room `navigator`: from a goal to commands, without ROS.
add_library(trident_nav_navigator
  src/navigator/avoided_places.cpp
  src/navigator/builtin_recoveries.cpp
  src/navigator/clear_costmap.cpp
  src/navigator/costmap_world.cpp
  src/navigator/move_slow.cpp
  src/navigator/navigator.cpp
  src/navigator/path_keeper.cpp
  src/navigator/retreat.cpp
  src/navigator/rotate.cpp
)
target_compile_features(trident_nav_navigator PUBLIC cxx_std_17)
target_compile_options(trident_nav_navigator PRIVATE -Wall -Wextra -ffp-contract=off)
target_include_directories(trident_nav_navigator PUBLIC include)
target_link_libraries(trident_nav_navigator PUBLIC trident_nav_costmap trident_nav_planning trident_nav_control)
trident_precompile_headers(trident_nav_navigator)
install(TARGETS trident_nav_navigator
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
)

if(CATKIN_ENABLE_TESTING)
  catkin_add_gtest(trident_nav_navigator_test
    test/navigator/avoided_places_test.cpp
    test/navigator/navigator_drive_test.cpp
    test/navigator/navigator_test.cpp
    test/navigator/recovery_test.cpp
    test/navigator/robot_world.cpp
  )
  target_include_directories(trident_nav_navigator_test PRIVATE test)
  target_link_libraries(trident_nav_navigator_test trident_nav_navigator gtest_main)
endif()

# --- what users of other stacks complain of, as a program ------------------------------------------
add_executable(nav_pain_scenes
  benchmark/pains/band_pains.cpp
  benchmark/pains/nav_pain_scenes.cpp
  benchmark/pains/obstacle_pains.cpp
  benchmark/pains/path_pains.cpp
  benchmark/pains/reason_pains.cpp
  benchmark/pains/tuning_pains.cpp
  test/control/grid_world.cpp
  test/control/scene.cpp
  test/navigator/robot_world.cpp
)
target_include_directories(nav_pain_scenes PRIVATE test)
target_compile_options(nav_pain_scenes PRIVATE -Wall -Wextra)
target_link_libraries(nav_pain_scenes trident_nav_navigator)
set_target_properties(nav_pain_scenes PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
