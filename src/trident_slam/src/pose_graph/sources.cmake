# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
target_sources(trident_slam PRIVATE
  src/pose_graph/block_cholesky.cpp
  src/pose_graph/block_symbolic.cpp
  src/pose_graph/chordal_start.cpp
  src/pose_graph/dense_kernels.cpp
  src/pose_graph/edge_model.cpp
  src/pose_graph/g2o_read.cpp
  src/pose_graph/g2o_write.cpp
  src/pose_graph/incremental_pose_graph.cpp
  src/pose_graph/pose_graph.cpp
  src/pose_graph/pose_graph_optimizer.cpp
  src/pose_graph/pose_system.cpp
  src/pose_graph/robust_kernel.cpp
  src/pose_graph/step_search.cpp
)
# The inner loops: unrolled and kept in registers.
set_source_files_properties(src/pose_graph/dense_kernels.cpp PROPERTIES COMPILE_OPTIONS -O3)
find_package(ZLIB REQUIRED)
find_library(AMD_LIBRARY amd REQUIRED)  # of SuiteSparse: minimum degree ordering
target_link_libraries(trident_slam PRIVATE ZLIB::ZLIB ${AMD_LIBRARY})

# Ceres as another back end, apart: who does not use it does not load it and its BLAS.
find_package(Ceres REQUIRED)
add_library(trident_slam_ceres src/pose_graph/ceres_solver.cpp)
target_compile_options(trident_slam_ceres PRIVATE -Wall -Wextra)
target_include_directories(trident_slam_ceres PRIVATE src)
target_link_libraries(trident_slam_ceres PUBLIC trident_slam PRIVATE Ceres::ceres)

add_executable(trident_slam_pose_graph src/pose_graph/pose_graph_main.cpp)
set_target_properties(trident_slam_pose_graph PROPERTIES OUTPUT_NAME pose_graph)
target_compile_options(trident_slam_pose_graph PRIVATE -Wall -Wextra)
target_link_libraries(trident_slam_pose_graph PRIVATE trident_slam trident_slam_ceres)

install(TARGETS trident_slam_ceres LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
install(TARGETS trident_slam_pose_graph RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
