#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-only
# Makes USER-ALEISPH a package of a LAMMPS source tree, as an alternative to the plugin:
#
#   tools/setup/in_tree.sh [--copy] LAMMPS
#
# LAMMPS is the top of a source tree that belongs to you; it is changed in two places, and running
# this again changes nothing more:
#   src/USER-ALEISPH       link to (with --copy: copy of) the package
#   cmake/CMakeLists.txt   the package in STANDARD_PACKAGES, how its sources are compiled, and
#                          where they find Eigen and, where there is one, hypre
# Then build LAMMPS as usual with  cmake -DPKG_USER-ALEISPH=on <your options> LAMMPS/cmake
set -euo pipefail

usage() {
  sed -n '3,/^set/{/^#/s/^# \{0,1\}//p}' "$0" >&2
  exit 2
}
fail() {
  printf 'in_tree.sh: %s\n' "$*" >&2
  exit 1
}

copy=
if [ "${1:-}" = --copy ]; then
  copy=yes
  shift
fi
[ $# -eq 1 ] || usage
case $1 in -*) usage ;; esac

package=$(cd "$(dirname "$0")/../../src/USER-ALEISPH" && pwd)
lists=$1/cmake/CMakeLists.txt
if [ ! -f "$1/src/lammps.h" ] || [ ! -f "$lists" ]; then
  fail "$1 is not the top of a LAMMPS source tree"
fi
grep -q '^set(STANDARD_PACKAGES$' "$lists" ||
  fail "$lists has no line 'set(STANDARD_PACKAGES': add USER-ALEISPH to its packages by hand"

target=$1/src/USER-ALEISPH
if [ -e "$target" ] && [ ! -L "$target" ] && [ ! -f "$target/fix_aleisph.h" ]; then
  fail "$target exists and is not this package"
fi
rm -rf "$target"
if [ -n "$copy" ]; then cp -R "$package" "$target"; else ln -s "$package" "$target"; fi

if ! grep -q '^  USER-ALEISPH$' "$lists"; then
  sed -i 's/^set(STANDARD_PACKAGES$/&\n  USER-ALEISPH/' "$lists"
fi
if ! grep -q 'PKG_USER-ALEISPH' "$lists"; then
  cat >>"$lists" <<'CMAKE'

# All of it for the sources of the package only: those of LAMMPS are compiled as without it. The
# options are those of the package's own CMakeLists.txt, which has the reasons.
if(PKG_USER-ALEISPH)
  option(ALEISPH_NATIVE "USER-ALEISPH for the processor at hand" ON)
  file(GLOB aleisph_sources ${LAMMPS_SOURCE_DIR}/USER-ALEISPH/*.cpp)
  find_package(Eigen3 REQUIRED NO_MODULE)
  set_property(SOURCE ${aleisph_sources} APPEND PROPERTY INCLUDE_DIRECTORIES
    $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
  set_property(SOURCE ${aleisph_sources} APPEND PROPERTY COMPILE_OPTIONS -Wno-psabi
    -ffp-contract=off -fno-math-errno -fno-trapping-math)
  if(ALEISPH_NATIVE)
    set_property(SOURCE ${aleisph_sources} APPEND PROPERTY COMPILE_OPTIONS -march=native)
  endif()
  find_path(HYPRE_INCLUDE_DIR HYPRE_parcsr_ls.h PATH_SUFFIXES hypre)
  find_library(HYPRE_LIBRARY HYPRE)
  if(BUILD_MPI AND HYPRE_INCLUDE_DIR AND HYPRE_LIBRARY)    # multigrid
    set_property(SOURCE ${aleisph_sources} APPEND PROPERTY COMPILE_DEFINITIONS ALEISPH_HYPRE)
    set_property(SOURCE ${aleisph_sources} APPEND PROPERTY INCLUDE_DIRECTORIES ${HYPRE_INCLUDE_DIR})
    target_link_libraries(lammps PRIVATE ${HYPRE_LIBRARY})
  endif()
endif()
CMAKE
fi
printf 'USER-ALEISPH is a package of %s; build with: cmake -DPKG_USER-ALEISPH=on ...\n' "$1"
