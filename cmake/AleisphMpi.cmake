# SPDX-License-Identifier: GPL-2.0-only
# The part of the numerics that talks to other ranks, aleisph_mpi_*.cpp, and the library hypre, whose
# multigrid it uses where it is found (Debian: libhypre-dev). MPI has been found with LAMMPS.

set(ALEISPH_HYPRE AUTO CACHE STRING "Multigrid of the library hypre: ON (required), OFF or AUTO")
set_property(CACHE ALEISPH_HYPRE PROPERTY STRINGS AUTO ON OFF)

file(GLOB mpi_sources CONFIGURE_DEPENDS ${ALEISPH_PACKAGE_DIR}/aleisph_mpi_*.cpp)
add_library(aleisph_mpi OBJECT ${mpi_sources})
target_include_directories(aleisph_mpi PUBLIC ${ALEISPH_PACKAGE_DIR})
target_link_libraries(aleisph_mpi PRIVATE aleisph_options PUBLIC MPI::MPI_CXX)

if(ALEISPH_HYPRE)    # AUTO is true, too
  find_path(HYPRE_INCLUDE_DIR HYPRE_parcsr_ls.h PATH_SUFFIXES hypre)
  find_library(HYPRE_LIBRARY HYPRE)
endif()
if(ALEISPH_HYPRE AND HYPRE_INCLUDE_DIR AND HYPRE_LIBRARY)
  target_compile_definitions(aleisph_mpi PRIVATE ALEISPH_HYPRE)
  target_include_directories(aleisph_mpi SYSTEM PRIVATE ${HYPRE_INCLUDE_DIR})
  target_link_libraries(aleisph_mpi PUBLIC ${HYPRE_LIBRARY})
  message(STATUS "Multigrid: hypre, ${HYPRE_LIBRARY}")
elseif(ALEISPH_HYPRE STREQUAL "AUTO" OR NOT ALEISPH_HYPRE)
  message(STATUS "Multigrid: none, hypre was not found or not wanted (ALEISPH_HYPRE=${ALEISPH_HYPRE})")
else()
  message(FATAL_ERROR "hypre was not found: install it (Debian: libhypre-dev), set "
                      "HYPRE_INCLUDE_DIR and HYPRE_LIBRARY, or pass -DALEISPH_HYPRE=OFF")
endif()
