# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
target_sources(trident_slam PRIVATE
  src/ekf_slam/chi_squared.cpp
  src/ekf_slam/ekf_slam.cpp
  src/ekf_slam/joint_compatibility.cpp
  src/ekf_slam/landmark_log.cpp
  src/ekf_slam/landmark_models.cpp
  src/ekf_slam/posts.cpp
)

add_executable(landmark_offline src/ekf_slam/landmark_offline.cpp)
target_include_directories(landmark_offline PRIVATE src)
target_link_libraries(landmark_offline trident_slam)
set_target_properties(landmark_offline PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
install(TARGETS landmark_offline RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
