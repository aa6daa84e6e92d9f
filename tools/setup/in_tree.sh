#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-only
# Makes USER-ALEISPH a package of a LAMMPS source tree, as an alternative to the plugin:
#
#   tools/setup/in_tree.sh [--copy] LAMMPS
#
# LAMMPS is the top of a source tree that belongs to you; it is changed in two places, and running
# this again changes nothing more:
#   src/USER-ALEISPH       link to (with --copy: copy of) the package
#   cmake/CMakeLists.txt   the package in STANDARD_PACKAGES, and where its sources find Eigen
#                          and, where there is one, hypre
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

if(PKG_USER-ALEISPH)
  find_package(Eigen3 REQUIRED NO_MODULE)
  target_include_directories(lammps SYSTEM PRIVATE
    $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
  find_path(HYPRE_INCLUDE_DIR HYPRE_parcsr_ls.h PATH_SUFFIXES hypre)
  find_library(HYPRE_LIBRARY HYPRE)
  if(BUILD_MPI AND HYPRE_INCLUDE_DIR AND HYPRE_LIBRARY)    # multigrid
    target_compile_definitions(lammps PRIVATE ALEISPH_HYPRE)
    target_include_directories(lammps SYSTEM PRIVATE ${HYPRE_INCLUDE_DIR})
    target_link_libraries(lammps PRIVATE ${HYPRE_LIBRARY})
  endif()
endif()
CMAKE
fi
printf 'USER-ALEISPH is a package of %s; build with: cmake -DPKG_USER-ALEISPH=on ...\n' "$1"
