#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-only
# The parts of tools/setup that need no network: mirrors found in both formats of apt sources,
# locks, the report on a failed step, the in-tree script.
set -euo pipefail

setup=$(cd "$(dirname "$0")/../../tools/setup" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export ALEISPH_CACHE=$work/cache
# shellcheck source=tools/setup/lib.sh
. "$setup/lib.sh"
# shellcheck source=tools/setup/packages.sh
. "$setup/packages.sh"
# shellcheck source=tools/setup/lammps.sh
. "$setup/lammps.sh"

failures=0
check() {    # check NAME EXPECTED FOUND
  if [ "$2" = "$3" ]; then return 0; fi
  printf 'FAILED: %s\n--- expected\n%s\n--- found\n%s\n' "$1" "$2" "$3"
  failures=$((failures + 1))
}
mirrors() {    # all sources written for the given apt files, one after the other
  rm -rf "$work/apt" && mkdir "$work/apt"
  write_debian_mirrors "$work/apt" trixie "$@"
  cat "$work"/apt/mirror-*.sources 2>/dev/null || true
}

cat >"$work/debian.sources" <<'EOF'
Types: deb
# a comment inside a stanza
URIs: http://one.example/debian http://two.example/debian
Suites: bookworm bookworm-updates
Components: main
Signed-By: /usr/share/keyrings/some.gpg

Types: deb
URIs: http://one.example/debian-security
Suites: bookworm-security
Components: main

Enabled: no
Types: deb
URIs: http://off.example/debian
Suites: stable
Components: main

Types: deb
URIs: http://other.example/vendor
Suites: nodistro
Components: main
EOF
check "deb822: mirrors of Debian itself, with their key" \
  "Types: deb-src
URIs: http://one.example/debian
Suites: trixie
Components: main
Signed-By: /usr/share/keyrings/some.gpg
Types: deb-src
URIs: http://two.example/debian
Suites: trixie
Components: main
Signed-By: /usr/share/keyrings/some.gpg" "$(mirrors "$work/debian.sources")"

cat >"$work/key.sources" <<'EOF'
Types: deb
URIs: http://three.example/debian
Suites: stable
Components: main contrib
Signed-By:
 -----BEGIN PGP PUBLIC KEY BLOCK-----
 .
 abc
 -----END PGP PUBLIC KEY BLOCK-----
EOF
check "deb822: a key inside the file" \
  "Types: deb-src
URIs: http://three.example/debian
Suites: trixie
Components: main
Signed-By:
 -----BEGIN PGP PUBLIC KEY BLOCK-----
 .
 abc
 -----END PGP PUBLIC KEY BLOCK-----" "$(mirrors "$work/key.sources")"

cat >"$work/sources.list" <<'EOF'
# deb http://comment.example/debian bookworm main
deb [arch=amd64 signed-by=/k.gpg] http://four.example/debian bookworm main contrib
deb-src http://four.example/debian bookworm main
deb http://five.example/debian bookworm-security main
deb http://six.example/ubuntu noble main
EOF
check "one-line: the same mirror once" \
  "Types: deb-src
URIs: http://four.example/debian
Suites: trixie
Components: main
Signed-By: /k.gpg" "$(mirrors "$work/sources.list")"

printf 'deb http://seven.example/debian sid main' >"$work/plain.list"
check "one-line: without key and newline, after another file" \
  "URIs: http://three.example/debian
URIs: http://seven.example/debian" "$(mirrors "$work/key.sources" "$work/plain.list" | grep URIs)"

if have dpkg-query; then
  check "packages: those that are not installed" "no-such-package-1
no-such-package-2" "$(missing_packages no-such-package-1 dpkg no-such-package-2)"
fi
check "unknown version of LAMMPS is refused" 1 \
  "$( (lammps_release 19990101) 2>/dev/null; echo $?)"
check "a failed step names the step, the end of its log and what to do" \
  "aleisph: failed (status 1): breaking
  the end of $work/log:
    a reason
  what to do: repair it" \
  "$( (run_step breaking "$work/log" "repair it" bash -c 'echo a reason; exit 1') 2>&1)"

with_lock "$work/lock" true
(with_lock "$work/lock" sleep 1) &
sleep 0.3
began=$(date +%s%N)
with_lock "$work/lock" true 2>"$work/waiting"
check "a lock makes the second caller wait and say so" "yes 1" \
  "$([ $((($(date +%s%N) - began) / 1000000)) -gt 300 ] && echo yes) $(grep -c waiting "$work/waiting")"
wait

# a source tree that an older version of the set-up unpacked lacks what was added to the list
mkdir -p "$work/archive/lammps-1/src" "$work/archive/lammps-1/python/lammps"
for part in "${LAMMPS_PARTS[@]}"; do mkdir -p "$work/archive/lammps-1/$part"; done
touch "$work/archive/lammps-1/python/lammps/core.py" "$work/archive/lammps-1/src/lammps.h"
tar -C "$work/archive" -czf "$work/lammps.tar.gz" lammps-1
LAMMPS_SOURCE_DIR=$work/cached
mkdir -p "$LAMMPS_SOURCE_DIR/src"
echo built >"$LAMMPS_SOURCE_DIR/src/lammps.h"
ALEISPH_LAMMPS_TARBALL=$work/lammps.tar.gz fetch_lammps 20250204
check "a cached source tree gets what it lacks, and no more" "core.py built" \
  "$(ls "$LAMMPS_SOURCE_DIR/python/lammps") $(cat "$LAMMPS_SOURCE_DIR/src/lammps.h")"
ALEISPH_LAMMPS_TARBALL=/no/such/file fetch_lammps 20250204
LAMMPS_SOURCE_DIR=$work/fresh
ALEISPH_LAMMPS_TARBALL=$work/lammps.tar.gz fetch_lammps 20250204
check "an empty cache gets all of it" "yes" "$(lammps_is_whole && echo yes)"

tree=$work/lammps
mkdir -p "$tree/src" "$tree/cmake"
touch "$tree/src/lammps.h"
printf 'set(STANDARD_PACKAGES\n  ADIOS\n  YAFF)\n' >"$tree/cmake/CMakeLists.txt"
bash "$setup/in_tree.sh" "$tree" >/dev/null
once=$(cat "$tree/cmake/CMakeLists.txt")
bash "$setup/in_tree.sh" "$tree" >/dev/null
check "in-tree: the second time changes nothing" "$once" "$(cat "$tree/cmake/CMakeLists.txt")"
check "in-tree: one line in the list of packages" "1" \
  "$(grep -c '^  USER-ALEISPH$' "$tree/cmake/CMakeLists.txt")"
check "in-tree: the package is reached" yes \
  "$([ -f "$tree/src/USER-ALEISPH/fix_aleisph.h" ] && echo yes)"
check "in-tree: another directory is refused" 1 \
  "$(bash "$setup/in_tree.sh" "$work/apt" >/dev/null 2>&1; echo $?)"

check "the threads of a program do not limit the build" "$(OMP_NUM_THREADS=1 bash -c \
  ". '$setup/lib.sh'; cores")" "$(OMP_NUM_THREADS=7 bash -c ". '$setup/lib.sh'; cores")"
first_core=$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//')
check "the cores that a process is bound to do" 1 \
  "$(taskset -c "$first_core" bash -c ". '$setup/lib.sh'; cores")"
check "that is what is built with" "$(cores)" \
  "$(ALEISPH_JOBS='' bash -c ". '$setup/lib.sh'; echo \"\$ALEISPH_JOBS\"")"

[ "$failures" -eq 0 ] && echo "all passed"
