# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# Puts our env.sh in the place of catkin's, in the devel space and in what is installed. Called after find_package(catkin), which
# writes its own at every configuration.
function(trident_generate_environment)
  configure_file("${CMAKE_SOURCE_DIR}/cmake/env.sh.in" "${CATKIN_DEVEL_PREFIX}/env.sh" COPYONLY)
  configure_file("${CMAKE_SOURCE_DIR}/cmake/env.sh.in" "${CMAKE_BINARY_DIR}/catkin_generated/installspace/env.sh" COPYONLY)
endfunction()
