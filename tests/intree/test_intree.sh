#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-only
# The package as a part of LAMMPS: a copy of the source tree is changed by tools/setup/in_tree.sh,
# built with -DPKG_USER-ALEISPH=on and must give the results of the plugin, digit by digit. The copy
# and its build stay in the working directory of the test, so that the next time only what has
# changed is compiled.
set -euo pipefail

: "${LAMMPS_SOURCE_DIR:?}" "${ALEISPH_SOURCE_DIR:?}" "${ALEISPH_LMP:?}" "${LAMMPS_PLUGIN_PATH:?}"
setup=$ALEISPH_SOURCE_DIR/tools/setup
# shellcheck source=tools/setup/lib.sh
. "$setup/lib.sh"
# shellcheck source=tools/setup/lammps_flags.sh
. "$setup/lammps_flags.sh"

# named like the original: then ccache sees the same relative paths
tree=$PWD/$(basename "$LAMMPS_SOURCE_DIR")
build=$PWD/build
mkdir -p "$tree"
for part in src cmake lib LICENSE README; do
  cp -a -u "$LAMMPS_SOURCE_DIR/$part" "$tree/"
done
bash "$setup/in_tree.sh" "$tree"

lammps_launcher "$PWD"
if [ ! -f "$build/build.ninja" ]; then
  cmake -G Ninja -S "$tree/cmake" -B "$build" -DPKG_USER-ALEISPH=on "${LAMMPS_CMAKE_FLAGS[@]}"
fi
cmake --build "$build" -j "$ALEISPH_JOBS" | tail -n 20

# results LMP: the result lines of a short run, without the time that it took
results() {
  "$1" -in in.poiseuille -var d 1e-4 -var marks 2 -log none >output.txt || {
    tail -n 20 output.txt
    return 1
  }
  grep '^ALEISPH-RESULT' output.txt | sed 's/ seconds=[^ ]*//'
}

rm -rf run && mkdir run && cd run
cp "$ALEISPH_SOURCE_DIR"/examples/poiseuille/* .
with_plugin=$(results "$ALEISPH_LMP")
# and its own library, not the one that the tests find for Python
unset LAMMPS_PLUGIN_PATH LD_LIBRARY_PATH
in_tree=$(results "$build/lmp")
printf 'plugin:\n%s\nin-tree:\n%s\n' "$with_plugin" "$in_tree"
[ -n "$in_tree" ] && [ "$in_tree" = "$with_plugin" ]
