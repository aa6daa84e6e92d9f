# SPDX-License-Identifier: GPL-2.0-only
# The imported target `lammps`: headers, liblammps and the definitions of an existing LAMMPS build.
# A plugin must be compiled with exactly the size settings of the program that loads it, so these
# are read from that build and not asked for.

set(LAMMPS_SOURCE_DIR "$ENV{LAMMPS_SOURCE_DIR}" CACHE PATH "LAMMPS source tree (has src/lammps.h)")
set(LAMMPS_BUILD_DIR "$ENV{LAMMPS_BUILD_DIR}" CACHE PATH "Where that tree was built with CMake")

set(hint "pass -DLAMMPS_SOURCE_DIR=... and -DLAMMPS_BUILD_DIR=..., or let ./aleisph obtain and \
build LAMMPS (./aleisph env prints both), or -DALEISPH_WITH_LAMMPS=off for the numerics alone")
if(NOT EXISTS "${LAMMPS_SOURCE_DIR}/src/lammps.h")
  message(FATAL_ERROR "LAMMPS_SOURCE_DIR='${LAMMPS_SOURCE_DIR}' has no src/lammps.h: ${hint}")
endif()
if(NOT EXISTS "${LAMMPS_BUILD_DIR}/CMakeCache.txt")
  message(FATAL_ERROR "LAMMPS_BUILD_DIR='${LAMMPS_BUILD_DIR}' has no CMakeCache.txt: ${hint}")
endif()

load_cache("${LAMMPS_BUILD_DIR}" READ_WITH_PREFIX their_
           LAMMPS_SIZES LAMMPS_MACHINE BUILD_MPI BUILD_SHARED_LIBS PKG_PLUGIN)
foreach(needed BUILD_MPI BUILD_SHARED_LIBS PKG_PLUGIN)
  if(NOT their_${needed})
    message(FATAL_ERROR "LAMMPS in ${LAMMPS_BUILD_DIR} was built without ${needed}: "
                        "configure it with -D${needed}=on and build it again")
  endif()
endforeach()
if(their_LAMMPS_MACHINE)
  string(PREPEND their_LAMMPS_MACHINE "_")
endif()

find_program(LAMMPS_EXECUTABLE lmp${their_LAMMPS_MACHINE}
             PATHS "${LAMMPS_BUILD_DIR}" NO_DEFAULT_PATH REQUIRED)
find_library(LAMMPS_LIBRARY lammps${their_LAMMPS_MACHINE}
             PATHS "${LAMMPS_BUILD_DIR}" NO_DEFAULT_PATH REQUIRED)

set(MPI_CXX_SKIP_MPICXX TRUE)    # as LAMMPS does: no obsolete C++ bindings
find_package(MPI REQUIRED COMPONENTS CXX)

string(TOUPPER "${their_LAMMPS_SIZES}" sizes)
add_library(lammps SHARED IMPORTED)
set_target_properties(lammps PROPERTIES IMPORTED_LOCATION "${LAMMPS_LIBRARY}")
target_include_directories(lammps SYSTEM INTERFACE "${LAMMPS_SOURCE_DIR}/src")
target_compile_definitions(lammps INTERFACE LAMMPS_${sizes} LMP_PLUGIN)
target_link_libraries(lammps INTERFACE MPI::MPI_CXX)

file(STRINGS "${LAMMPS_SOURCE_DIR}/src/version.h" version REGEX "LAMMPS_VERSION")
string(REGEX REPLACE ".*\"(.*)\".*" "\\1" LAMMPS_VERSION "${version}")
message(STATUS "LAMMPS ${LAMMPS_VERSION} (${their_LAMMPS_SIZES}): ${LAMMPS_LIBRARY}")
