# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
#
# Debian's message headers (std_msgs, geometry_msgs, ...) and ros/serialization.h use allocator::rebind, which
# C++20 removed; gencpp itself has moved on to allocator_traits. This writes copies with that one expression
# replaced, naming the same types, and puts them first on the include path of the including directory.

set(TRIDENT_ROS_MESSAGES_DIR "${CMAKE_BINARY_DIR}/ros_messages_cxx20")

function(_trident_copy_message_headers)
  file(GLOB headers RELATIVE /usr/include
       /usr/include/*_msgs/*.h /usr/include/ros/*.h /usr/include/std_srvs/*.h /usr/include/roscpp/*.h /usr/include/bond/*.h
       /usr/include/topic_tools/*.h /usr/include/dynamic_reconfigure/*.h /usr/include/nodelet/*.h
       /usr/include/tf/*.h)
  foreach(header IN LISTS headers)
    set(copy "${TRIDENT_ROS_MESSAGES_DIR}/${header}")
    if(NOT "/usr/include/${header}" IS_NEWER_THAN "${copy}")
      continue()
    endif()
    file(READ "/usr/include/${header}" text)
    if(NOT text MATCHES "ContainerAllocator::template rebind<")
      continue()
    endif()
    string(REPLACE "typename ContainerAllocator::template rebind<"
                   "typename std::allocator_traits<ContainerAllocator>::template rebind_alloc<" text "${text}")
    string(REPLACE ">::other" ">" text "${text}")
    get_filename_component(package "${header}" DIRECTORY)
    string(REGEX REPLACE "#include \"([a-z_]+\\.h)\"" "#include <${package}/\\1>" text "${text}")  # a sibling
    file(WRITE "${copy}" "${text}")
  endforeach()
endfunction()

get_property(_trident_copied GLOBAL PROPERTY TRIDENT_ROS_MESSAGES_COPIED)
if(NOT _trident_copied)
  _trident_copy_message_headers()
  set_property(GLOBAL PROPERTY TRIDENT_ROS_MESSAGES_COPIED TRUE)
endif()
include_directories(BEFORE SYSTEM "${TRIDENT_ROS_MESSAGES_DIR}")
