# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# Lets C++20 code include Debian's ROS message headers: corrected copies go first on the include path of everything below the
# including directory. Included by the workspace; a package needs nothing, but may name TRIDENT_ROS_MESSAGES_DIR.

set(TRIDENT_ROS_MESSAGES_DIR "${CMAKE_BINARY_DIR}/message_headers")

get_property(_trident_ros_messages_done GLOBAL PROPERTY TRIDENT_ROS_MESSAGES_DONE)
if(NOT _trident_ros_messages_done)
  set(_trident_script "${CMAKE_CURRENT_LIST_DIR}/modernise_message_headers.py")
  execute_process(
    COMMAND ${PYTHON_EXECUTABLE} "${_trident_script}" /usr/share /usr/include "${TRIDENT_ROS_MESSAGES_DIR}"
    RESULT_VARIABLE _trident_result)
  if(NOT _trident_result EQUAL 0)
    message(FATAL_ERROR "Could not prepare Debian's ROS message headers for C++20")
  endif()
  include_directories(BEFORE SYSTEM "${TRIDENT_ROS_MESSAGES_DIR}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${_trident_script}")
  set_property(GLOBAL PROPERTY TRIDENT_ROS_MESSAGES_DONE TRUE)
endif()
