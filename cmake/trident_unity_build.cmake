# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# Sources of a target are compiled a few at a time, as one (a unity build): most of the time goes to headers, which are
# then read once. tools/trident_tool/unity_build.py says which go together. Sources with compiler options of their own stay
# alone, as does what is generated (one unit per header, to show that each compiles by itself), and targets with
# UNITY_BUILD OFF. With TRIDENT_UNITY_BUILD off each source is compiled alone: for clangd, and to show that it includes what
# it uses.
option(TRIDENT_UNITY_BUILD "Compile sources a few at a time, as one" ON)

function(trident_append_unity_sources folder file)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(NOT type MATCHES "^(EXECUTABLE|SHARED_LIBRARY|STATIC_LIBRARY|MODULE_LIBRARY|OBJECT_LIBRARY)$")
      continue()
    endif()
    get_target_property(unity ${target} UNITY_BUILD)
    if(NOT unity STREQUAL "unity-NOTFOUND" AND NOT unity)
      continue()
    endif()
    get_target_property(sources ${target} SOURCES)
    get_target_property(source_folder ${target} SOURCE_DIR)
    foreach(source ${sources})
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${source_folder}" NORMALIZE)
      get_source_file_property(options "${source}" TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
      cmake_path(IS_PREFIX CMAKE_BINARY_DIR "${source}" is_generated)
      if(source MATCHES "\\.cpp$" AND NOT options AND NOT is_generated)
        file(APPEND "${file}" "${target}\t${source}\n")
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
      endif()
    endforeach()
  endforeach()
  get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(subfolder ${subfolders})
    trident_append_unity_sources("${subfolder}" "${file}")
  endforeach()
endfunction()

function(trident_unity_group target number source)
  set_source_files_properties("${source}" TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${target}_${number})
endfunction()

# A source that shares its group with no other: compiled as it is. The call keeps its number.
function(trident_unity_alone target number source)
endfunction()

# To be called when all targets are there.
function(trident_unity_build)
  set(list "${CMAKE_BINARY_DIR}/unity_sources.txt")
  set(groups "${CMAKE_BINARY_DIR}/unity_groups.cmake")
  file(REMOVE "${list}")
  if(NOT TRIDENT_UNITY_BUILD)
    return()
  endif()
  trident_append_unity_sources("${CMAKE_SOURCE_DIR}" "${list}")
  execute_process(COMMAND "${PYTHON_EXECUTABLE}" -m trident_tool.unity_build "${CMAKE_BINARY_DIR}"
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}/tools" COMMAND_ERROR_IS_FATAL ANY)
  include("${groups}")  # which makes cmake run again when it changes
endfunction()
