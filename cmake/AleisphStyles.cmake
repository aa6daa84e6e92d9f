# SPDX-License-Identifier: GPL-2.0-only
# The LAMMPS styles, as objects for the plugin and the tests, and the list of their headers.
# LAMMPS finds the headers of a package by their prefix; so does this list, so that the name of a
# style stands in one place only, the FixStyle or ComputeStyle macro of its header.

file(GLOB style_sources CONFIGURE_DEPENDS
     ${ALEISPH_PACKAGE_DIR}/fix_*.cpp ${ALEISPH_PACKAGE_DIR}/compute_*.cpp)
file(GLOB style_headers RELATIVE ${ALEISPH_PACKAGE_DIR} CONFIGURE_DEPENDS
     ${ALEISPH_PACKAGE_DIR}/fix_*.h ${ALEISPH_PACKAGE_DIR}/compute_*.h)

set(list "// Made by CMake: the headers of all styles. To be included more than once.\n")
foreach(header IN LISTS style_headers)
  string(APPEND list "#include \"${header}\"\n")
endforeach()
file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/include/aleisph_style_headers.h CONTENT "${list}")

add_library(aleisph_styles OBJECT ${style_sources})
target_include_directories(aleisph_styles PUBLIC
  ${CMAKE_BINARY_DIR}/include ${CMAKE_SOURCE_DIR}/plugin)
target_link_libraries(aleisph_styles PRIVATE aleisph_options
                      PUBLIC lammps aleisph_numerics aleisph_mpi)
