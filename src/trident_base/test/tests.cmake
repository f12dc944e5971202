# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# One translation unit per public header: each must compile on its own.
file(GLOB trident_base_headers RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/include
  CONFIGURE_DEPENDS include/trident_base/*.h)
set(header_sources)
foreach(header IN LISTS trident_base_headers)
  string(REPLACE "/" "_" name ${header})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n")
  list(APPEND header_sources ${source})
endforeach()

catkin_add_gtest(trident_base_test
  test/angle_test.cpp
  test/vehicle/bicycle_odometry_test.cpp
  test/config/config_document_test.cpp
  test/config/config_error_test.cpp
  test/config/config_fields_test.cpp
  test/vehicle/diff_drive_odometry_test.cpp
  test/gauss_markov_test.cpp
  test/noise_test.cpp
  test/mutex_test.cpp
  test/option_number_test.cpp
  test/random_stream_test.cpp
  test/registry_test.cpp
  test/se2_test.cpp
  test/se3_test.cpp
  test/sha256_test.cpp
  test/sim_time_test.cpp
  test/so3_test.cpp
  test/span_test.cpp
  test/shown_text_test.cpp
  test/string_util_test.cpp
  test/vehicle/thruster_curve_test.cpp
  test/vehicle/wheel_encoder_test.cpp
  test/utc_clock_test.cpp
  test/worker_pool_test.cpp
  test/config/yaml_config_test.cpp
  test/config/yaml_tree_test.cpp
  ${header_sources}
)
target_link_libraries(trident_base_test trident_base ${GTEST_MAIN_LIBRARIES})
trident_precompile_headers(trident_base_test <gtest/gtest.h>)
set_source_files_properties(${header_sources} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)

# A malloc that counts, for the tests of this package and of others.
add_library(trident_base_test_support STATIC test_support/allocation_count.cpp)
target_include_directories(trident_base_test_support PUBLIC test_support)
target_compile_options(trident_base_test_support PRIVATE -Wall -Wextra)

# Alone, because it replaces malloc.
catkin_add_gtest(trident_base_allocation_test test/allocation_test.cpp)
target_link_libraries(trident_base_allocation_test trident_base trident_base_test_support ${GTEST_MAIN_LIBRARIES})
