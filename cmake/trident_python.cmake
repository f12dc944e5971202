# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# Python tests and static checks as ctest tests. Included by the workspace before its packages.

# trident_add_pytest(<name> <directory or file> [TIMEOUT <seconds>] [LABELS <label>...] [SERIAL])
#
# Registers a test that runs pytest in the built workspace's environment, with the package's src/ importable. TIMEOUT is wall
# time, default 300. SERIAL keeps other tests from running at the same time; for tests that judge wall-clock behaviour.
function(trident_add_pytest name path)
  cmake_parse_arguments(arg "SERIAL" "TIMEOUT" "LABELS" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "trident_add_pytest(${name}): unknown arguments: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  get_filename_component(path "${path}" ABSOLUTE)
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_test(NAME ${name}
    COMMAND "${CATKIN_DEVEL_PREFIX}/env.sh" "${CMAKE_SOURCE_DIR}/.venv/bin/python" -m pytest -q "${path}"
            "--rootdir=${CMAKE_SOURCE_DIR}" "--config-file=${CMAKE_SOURCE_DIR}/pyproject.toml"
            "--junitxml=${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/pytest-${name}.xml"
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  set(environment "PATH=path_list_prepend:/usr/bin"
                  "HYPOTHESIS_STORAGE_DIRECTORY=set:${CMAKE_BINARY_DIR}/hypothesis")
  if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/src")
    list(APPEND environment "PYTHONPATH=path_list_prepend:${PROJECT_SOURCE_DIR}/src")
  endif()
  set_tests_properties(${name} PROPERTIES
    TIMEOUT ${arg_TIMEOUT}
    LABELS "pytest;${arg_LABELS}"
    ENVIRONMENT_MODIFICATION "${environment}"
    RUN_SERIAL ${arg_SERIAL})
endfunction()

# trident_add_lint(<check> [TIMEOUT <seconds>] [PROCESSORS <n>])
#
# Registers a static check of tools/trident_tool/lint.py as test lint_<check>.
function(trident_add_lint check)
  cmake_parse_arguments(arg "" "TIMEOUT;PROCESSORS" "" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  if(NOT arg_PROCESSORS)
    set(arg_PROCESSORS 1)
  endif()
  add_test(NAME lint_${check}
    COMMAND /usr/bin/python3 "${CMAKE_SOURCE_DIR}/tools/lint.py" ${check}
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}")
  set_tests_properties(lint_${check} PROPERTIES
    TIMEOUT ${arg_TIMEOUT} LABELS lint PROCESSORS ${arg_PROCESSORS})
endfunction()
