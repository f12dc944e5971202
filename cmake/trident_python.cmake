# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# Python tests and static checks as ctest tests. Included by the workspace before its packages.

# trident_add_pytest(<name> <directory or file> [TIMEOUT <seconds>] [LABELS <label>...] [APART <file or folder>...] [SERIAL])
#
# Registers a test that runs pytest in the built workspace's environment, with the package's src/ importable. TIMEOUT, default 300,
# is time as far as the machine gives it to the test and what that has started (trident.patience); ctest's own limit, of wall
# time, is ten times as long. APART are the long ones in the directory: each is a test <name>_<file> of its own, so that they run
# side by side and none of them waits for the others. SERIAL keeps other tests from running at the same time; for tests that
# judge wall-clock behaviour.
function(trident_add_pytest name path)
  cmake_parse_arguments(arg "SERIAL" "TIMEOUT" "LABELS;APART" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "trident_add_pytest(${name}): unknown arguments: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  get_filename_component(path "${path}" ABSOLUTE)
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  math(EXPR wall_limit "10 * ${arg_TIMEOUT}")
  set(ignored "")
  foreach(part IN LISTS arg_APART)
    if(NOT EXISTS "${path}/${part}")
      message(FATAL_ERROR "trident_add_pytest(${name}): APART ${part} is not in ${path}")
    endif()
    get_filename_component(stem "${part}" NAME_WE)
    string(REGEX REPLACE "^test_" "" stem "${stem}")
    set(serial "")
    if(arg_SERIAL)
      set(serial SERIAL)
    endif()
    trident_add_pytest(${name}_${stem} "${path}/${part}" TIMEOUT ${arg_TIMEOUT} LABELS ${arg_LABELS} ${serial})
    list(APPEND ignored "--ignore=${path}/${part}")
  endforeach()
  add_test(NAME ${name}
    COMMAND "${CATKIN_DEVEL_PREFIX}/env.sh" "${CMAKE_SOURCE_DIR}/.venv/bin/python" -m pytest -q "${path}" ${ignored}
            -p trident.pytest_limit
            "--rootdir=${CMAKE_SOURCE_DIR}" "--config-file=${CMAKE_SOURCE_DIR}/pyproject.toml"
            "--junitxml=${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/pytest-${name}.xml"
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  set(environment "PATH=path_list_prepend:/usr/bin"
                  "TRIDENT_TEST_LIMIT_S=set:${arg_TIMEOUT}"
                  "HYPOTHESIS_STORAGE_DIRECTORY=set:${CMAKE_BINARY_DIR}/hypothesis")
  if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/src")
    list(APPEND environment "PYTHONPATH=path_list_prepend:${PROJECT_SOURCE_DIR}/src")
  endif()
  set_tests_properties(${name} PROPERTIES
    TIMEOUT ${wall_limit}
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
    set(arg_TIMEOUT 3000)
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
