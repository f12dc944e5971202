# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room `core`: geometry, footprints and what they touch.
add_library(trident_nav_core
  src/core/footprint.cpp
  src/core/footprint_checker.cpp
  src/core/path_cusps.cpp
  src/core/shape_cells.cpp
)
target_compile_features(trident_nav_core PUBLIC cxx_std_17)
target_compile_options(trident_nav_core PRIVATE -Wall -Wextra -ffp-contract=off)
target_include_directories(trident_nav_core PUBLIC include)
target_link_libraries(trident_nav_core PUBLIC trident_base Eigen3::Eigen)
install(TARGETS trident_nav_core
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
)
