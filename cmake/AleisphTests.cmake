# SPDX-License-Identifier: GPL-2.0-only
# How tests are declared.
#   aleisph_gtest(target LABEL label)                    every TEST of a GoogleTest program
#   aleisph_script(name LABEL label [RANKS n] [TIMEOUT s] COMMAND script args...)
#                                                        one Python or bash script
#   aleisph_scripts([GLOB pattern] [PREFIX text] LABEL label [RANKS n] [TIMEOUT s])
#                                                        every test_NAME.py as label.[text]NAME
# Scripts run in a directory of their own below the build directory and find in their environment:
#   ALEISPH_SOURCE_DIR      top of this source tree
#   ALEISPH_LMP             the program lmp; LAMMPS_PLUGIN_PATH is set, so that it knows the styles
#   ALEISPH_MPIEXEC         the MPI starter (mpirun)
#   LAMMPS_SOURCE_DIR, LAMMPS_BUILD_DIR, LAMMPS_POTENTIALS
#   PYTHONPATH              tools/ and tests/support/ of this tree, and LAMMPS' own Python module
#   LD_LIBRARY_PATH         has liblammps.so for that module

include(GoogleTest)
find_package(GTest REQUIRED)

# The Python that has numpy: the system's own, before whatever comes first in PATH
find_program(ALEISPH_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(ALEISPH_PYTHON NAMES python3 REQUIRED)

# Several runs share the cores of one machine: no binding, more ranks than cores allowed, idle
# ranks give way. Containers: root may start ranks, and the kernel may forbid one process to copy
# from another's memory (CMA). First for Open MPI 4, then for 5.
set(ALEISPH_TEST_ENVIRONMENT
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  PRTE_ALLOW_RUN_AS_ROOT=1 PRTE_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
  OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
  PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
  PRTE_MCA_hwloc_default_binding_policy=none OMPI_MCA_btl_sm_single_copy_mechanism=none
  OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
  ALEISPH_SOURCE_DIR=${PROJECT_SOURCE_DIR}
  LAMMPS_POTENTIALS=${PROJECT_SOURCE_DIR}/potentials
  PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg)
set(python_path ${PROJECT_SOURCE_DIR}/tools:${PROJECT_SOURCE_DIR}/tests/support)
if(ALEISPH_WITH_LAMMPS)
  string(APPEND python_path :${LAMMPS_SOURCE_DIR}/python)
  set(library_path ${LAMMPS_BUILD_DIR})
  if(NOT "$ENV{LD_LIBRARY_PATH}" STREQUAL "")
    string(APPEND library_path :$ENV{LD_LIBRARY_PATH})
  endif()
  list(APPEND ALEISPH_TEST_ENVIRONMENT
    ALEISPH_MPIEXEC=${MPIEXEC_EXECUTABLE} ALEISPH_LMP=${LAMMPS_EXECUTABLE}
    LAMMPS_SOURCE_DIR=${LAMMPS_SOURCE_DIR} LAMMPS_BUILD_DIR=${LAMMPS_BUILD_DIR}
    LD_LIBRARY_PATH=${library_path})
endif()
list(APPEND ALEISPH_TEST_ENVIRONMENT PYTHONPATH=${python_path})

# ctest reads this file when it starts and hands its environment on (as a property of the tests
# found by gtest_discover_tests, a list of variables does not survive). GoogleTest programs register
# the styles themselves and must not load the plugin; scripts get it in aleisph_script().
set(lines "unset(ENV{LAMMPS_PLUGIN_PATH})\n")
foreach(pair IN LISTS ALEISPH_TEST_ENVIRONMENT)
  string(REGEX REPLACE "^([^=]*)=(.*)$" "set(ENV{\\1} \"\\2\")\n" line "${pair}")
  string(APPEND lines "${line}")
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/test_environment.cmake "${lines}")
set_property(DIRECTORY APPEND PROPERTY
             TEST_INCLUDE_FILES ${PROJECT_BINARY_DIR}/test_environment.cmake)

# what the sanitizers are told about leaks
function(aleisph_sanitizer_options target)
  if(ALEISPH_SANITIZE)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/sanitizer_options.cpp)
  endif()
endfunction()

function(aleisph_gtest target)
  cmake_parse_arguments(arg "" "LABEL" "" ${ARGN})
  target_compile_definitions(${target} PRIVATE
    ALEISPH_TEST_DATA="${PROJECT_SOURCE_DIR}/tests" ALEISPH_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  aleisph_sanitizer_options(${target})
  # the names are asked for when the tests start: a program that cannot run does not stop the build
  gtest_discover_tests(${target} TEST_PREFIX "${arg_LABEL}." DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${arg_LABEL} TIMEOUT 600)
endfunction()

function(aleisph_script name)
  cmake_parse_arguments(arg "" "LABEL;RANKS;TIMEOUT" "COMMAND" ${ARGN})
  list(POP_FRONT arg_COMMAND script)
  get_filename_component(script "${script}" ABSOLUTE)
  if(script MATCHES "\\.sh$")
    set(interpreter bash)
  else()
    set(interpreter ${ALEISPH_PYTHON})
  endif()
  if(NOT arg_RANKS)
    set(arg_RANKS 1)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 600)
  endif()
  set(work ${PROJECT_BINARY_DIR}/tests/work/${arg_LABEL}.${name})
  file(MAKE_DIRECTORY ${work})
  add_test(NAME ${arg_LABEL}.${name} COMMAND ${interpreter} ${script} ${arg_COMMAND}
           WORKING_DIRECTORY ${work})
  set_tests_properties(${arg_LABEL}.${name} PROPERTIES
    LABELS ${arg_LABEL} PROCESSORS ${arg_RANKS} TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT LAMMPS_PLUGIN_PATH=${PROJECT_BINARY_DIR}/plugin)
endfunction()

function(aleisph_scripts)
  cmake_parse_arguments(arg "" "GLOB;PREFIX" "" ${ARGN})
  if(NOT arg_GLOB)
    set(arg_GLOB test_*.py)
  endif()
  file(GLOB scripts CONFIGURE_DEPENDS ${arg_GLOB})
  foreach(script IN LISTS scripts)
    get_filename_component(name ${script} NAME_WE)
    string(REGEX REPLACE "^test_" "${arg_PREFIX}" name ${name})
    aleisph_script(${name} ${arg_UNPARSED_ARGUMENTS} COMMAND ${script})
  endforeach()
endfunction()
