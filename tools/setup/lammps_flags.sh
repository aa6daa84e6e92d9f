# shellcheck shell=bash
# SPDX-License-Identifier: GPL-2.0-only
# How LAMMPS is configured, here and in the in-tree test. SPH, BPM and RHEO are only for the
# comparisons in bench/; RHEO needs LAPACK, and Debian's source archive carries no bundled one.
# The other packages are those that scenes with this one often want: solids, more fixes, computes
# and dumps, compressed files; PNG and JPEG are for dump image.
# shellcheck disable=SC2034
LAMMPS_CMAKE_FLAGS=(
  -DCMAKE_BUILD_TYPE=Release
  -DBUILD_MPI=on -DBUILD_SHARED_LIBS=on -DBUILD_OMP=off -DBUILD_TOOLS=off
  -DPKG_PLUGIN=on
  -DPKG_RIGID=on -DPKG_MOLECULE=on -DPKG_GRANULAR=on -DPKG_COMPRESS=on
  -DPKG_EXTRA-FIX=on -DPKG_EXTRA-COMPUTE=on -DPKG_EXTRA-DUMP=on -DPKG_EXTRA-PAIR=on
  -DPKG_SPH=on -DPKG_BPM=on -DPKG_RHEO=on
  -DWITH_JPEG=on -DWITH_PNG=on -DWITH_GZIP=on -DWITH_FFMPEG=off
  "-DCMAKE_EXE_LINKER_FLAGS=-Wl,--no-as-needed -lopenblas -llapack"
  "-DCMAKE_SHARED_LINKER_FLAGS=-Wl,--no-as-needed -lopenblas -llapack"
)

# LAMMPS_LAUNCHER ROOT: uses ccache if there is one. Paths below ROOT are taken relative, so that
# two trees with the same layout below their roots share objects.
lammps_launcher() {
  command -v ccache >/dev/null 2>&1 || return 0
  export CCACHE_DIR=$ALEISPH_CACHE/ccache CCACHE_BASEDIR=$1 CCACHE_SLOPPINESS=locale
  LAMMPS_CMAKE_FLAGS+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache)
}
