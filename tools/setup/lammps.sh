# shellcheck shell=bash
# SPDX-License-Identifier: GPL-2.0-only
# Obtains LAMMPS and builds it once into the cache. Sourced, not run. Uses lib.sh, packages.sh.
#   LAMMPS_SOURCE_DIR and LAMMPS_BUILD_DIR   the user's own build: used as it is
#   LAMMPS_SOURCE_DIR                        the user's sources: built in the cache
#   ALEISPH_LAMMPS_TARBALL                   the release as a file: for machines without network
#   ALEISPH_LAMMPS                           version, one of the table below

here=$(dirname "${BASH_SOURCE[0]}")
# shellcheck source=tools/setup/lammps_flags.sh
. "$here/lammps_flags.sh"

# Per version: the Debian suite that carries its source package; the tag of the release; the
# sha256 of the tag's archive, as the package "lammps" of Spack publishes it.
lammps_release() {
  case $1 in
    20250204)
      suite=trixie
      tag=patch_4Feb2025
      sha256=a4cb0a58451d47ac31ee3e1f148d92f445298d6e27f2d06f161b9b4168d79eb1
      ;;
    20260704)
      suite=sid
      tag=patch_4Jul2026
      sha256=be9deffba169d140c337fd29570d3f5469332ece7e77280cce998f6caaad5534
      ;;
    *) die "ALEISPH_LAMMPS=$1 is not known; known: 20250204 (default), 20260704.
For any other version set LAMMPS_SOURCE_DIR to its source tree" ;;
  esac
}

# Writes one apt source per Debian mirror that the machine itself uses: $1/mirror-N.sources, with
# the machine's URI and key, for source packages of suite $2. Reads both formats of apt.
write_debian_mirrors() {
  awk -v dir="$1" -v suite="$2" '
    function known(list,    n, i, part) {
      n = split(list, part, " ")
      for (i = 1; i <= n; i++)
        if (part[i] ~ /^(stable|oldstable|testing|unstable|sid|bookworm|trixie|forky)$/) return 1
      return 0
    }
    function emit(uri, key,    file) {
      if (uri == "" || uri in seen) return
      seen[uri] = 1
      file = dir "/mirror-" ++count ".sources"
      printf "Types: deb-src\nURIs: %s\nSuites: %s\nComponents: main\n", uri, suite > file
      if (key != "") printf "Signed-By:%s\n", key > file
      close(file)
    }
    function end_stanza(    n, i, part) {
      if (field["types"] != "" && field["enabled"] !~ /no/ && known(field["suites"]) &&
          field["components"] ~ /main/) {
        n = split(field["uris"], part, " ")
        for (i = 1; i <= n; i++) emit(part[i], field["signed-by"])
      }
      split("", field)
    }
    FNR == 1 { end_stanza() }
    /^[ \t]*#/ { next }
    FILENAME ~ /\.list$/ {
      if ($1 != "deb" && $1 != "deb-src") next
      key = ""
      if (match($0, /\[[^]]*\]/)) {
        options = substr($0, RSTART + 1, RLENGTH - 2)
        $0 = substr($0, 1, RSTART - 1) " " substr($0, RSTART + RLENGTH)
        n = split(options, part, " ")
        for (i = 1; i <= n; i++) if (sub(/^signed-by=/, "", part[i])) key = " " part[i]
      }
      if (known($3) && $0 ~ / main/) emit($2, key)
      next
    }
    /^[ \t]*$/ { end_stanza(); next }
    /^[ \t]/ { field[name] = field[name] "\n" $0; next }
    {
      name = tolower($0); sub(/:.*/, "", name)
      value = $0; sub(/^[^:]*:/, "", value)
      field[name] = value
    }
    END { end_stanza() }
  ' "${@:3}"
}

# apt_private SOURCE COMMAND...: an apt command on one source, with list and cache of its own, so
# that the state of the machine is neither used nor changed
apt_private() {
  local source=$1 dir command=$2
  shift 2
  dir=${source%.sources}
  mkdir -p "$dir/lists/partial" "$dir/cache/archives/partial"
  "$command" -o Dir::Etc::sourcelist="$source" -o Dir::Etc::sourceparts=/dev/null \
    -o Dir::State::lists="$dir/lists" -o Dir::Cache="$dir/cache" \
    -o APT::Sandbox::User=root -o APT::Update::Error-Mode=any "$@"
}

# The first version of the source package lammps that starts with $2
apt_lammps_version() {
  apt_private "$1" apt-cache showsrc --only-source lammps |
    sed -n 's/^Version: //p' | grep -m 1 "^$2"
}

# try_debian_mirror SOURCE VERSION: downloads the source archive into the current directory
try_debian_mirror() {
  local version
  apt_private "$1" apt-get update || return 1
  version=$(apt_lammps_version "$1" "$2") || {
    echo "this mirror has no source package lammps $2"
    return 1
  }
  apt_private "$1" apt-get source --tar-only --download-only "lammps=$version"
}

download_from_debian() {
  local version=$1 suite=$2 dir=$3 apt=$ALEISPH_CACHE/apt/$2 source files=()
  rm -f "$apt"/mirror-*.sources
  mkdir -p "$apt"
  for source in /etc/apt/sources.list /etc/apt/sources.list.d/*.list \
    /etc/apt/sources.list.d/*.sources; do
    if [ -r "$source" ]; then files+=("$source"); fi
  done
  [ "${#files[@]}" -gt 0 ] || { echo "no apt sources on this machine"; return 1; }
  write_debian_mirrors "$apt" "$suite" "${files[@]}"
  for source in "$apt"/mirror-*.sources; do
    [ -e "$source" ] || { echo "no Debian mirror among the apt sources of this machine"; return 1; }
    echo "--- $(sed -n 's/^URIs: //p' "$source"), suite $suite"
    if (cd "$dir" && try_debian_mirror "$source" "$version"); then return 0; fi
  done
  return 1
}

download_release() {
  cmake -DURL="https://github.com/lammps/lammps/archive/$2.tar.gz" -DSHA256="$3" \
    -DFILE="$4/$2.tar.gz" -P "$here/download.cmake"
}

# Why the download from Debian failed, in one line, for the message of the next attempt
debian_failure() {
  if grep -Eq 'NO_PUBKEY|Missing key' "$1"; then
    echo "the Debian keyring of this machine is older than the suite's key
    (apt-get install --only-upgrade debian-archive-keyring brings the new one)"
  else
    grep -E '^(E:|Err:|no |this )' "$1" | tail -n 1
  fi
}

# download_lammps VERSION: prints the path of the archive
download_lammps() {
  local version=$1 suite tag sha256 dir=$ALEISPH_CACHE/download/$1 log
  log=$ALEISPH_CACHE/log/download-$version
  lammps_release "$version"
  mkdir -p "$dir"
  if have apt-get && [ -r /etc/debian_version ]; then
    if try_step "LAMMPS $version: source archive of Debian $suite, from this machine's mirror" \
      "$log-debian.log" download_from_debian "$version" "$suite" "$dir"; then
      find "$dir" -name 'lammps_*.tar.*' | head -n 1
      return 0
    fi
    say "  not from there: $(debian_failure "$log-debian.log"); log: $log-debian.log"
  fi
  run_step "LAMMPS $version: release $tag from GitHub" "$log-github.log" \
    "unpack LAMMPS $version anywhere and set LAMMPS_SOURCE_DIR to it, or set \
ALEISPH_LAMMPS_TARBALL to its archive, then run this again" \
    download_release "$version" "$tag" "$sha256" "$dir"
  printf '%s\n' "$dir/$tag.tar.gz"
}

# Only what a build, its users and the comparisons read: a fifth of the archive
LAMMPS_PARTS=(src cmake lib python tools/python LICENSE README examples/rheo)

# unpack_parts ARCHIVE DEST PART...: those that DEST lacks. Some archives have one directory on top,
# lammps-..., some have none.
unpack_parts() {
  local archive=$1 dest=$2 first top='' part members=()
  shift 2
  first=$(tar -tf "$archive" 2>/dev/null | head -n 1) || true
  case $first in lammps*/*) top=${first%%/*}/ ;; esac
  for part in "$@"; do [ -e "$dest/$part" ] || members+=("$top$part"); done
  [ "${#members[@]}" -gt 0 ] || return 0
  tar -x -f "$archive" -C "$dest" ${top:+--strip-components=1} "${members[@]}"
}

unpack_lammps() {
  local archive=$1 dest=$2
  rm -rf "$dest.part" &&
    mkdir -p "$dest.part" &&
    unpack_parts "$archive" "$dest.part" "${LAMMPS_PARTS[@]}" &&
    mv "$dest.part" "$dest"
}

# Whether nothing is missing that an older version of this script did not unpack
lammps_is_whole() {
  local part
  for part in "${LAMMPS_PARTS[@]}"; do [ -e "$LAMMPS_SOURCE_DIR/$part" ] || return 1; done
}

# fetch_lammps VERSION: fills LAMMPS_SOURCE_DIR
fetch_lammps() {
  local version=$1 archive unpack=(unpack_lammps)
  ! lammps_is_whole || return 0
  archive=${ALEISPH_LAMMPS_TARBALL:-}
  [ -n "$archive" ] || archive=$(download_lammps "$version") || exit 1
  [ ! -d "$LAMMPS_SOURCE_DIR" ] || unpack=(unpack_parts)
  run_step "unpacking $(basename "$archive")" "$ALEISPH_CACHE/log/unpack.log" \
    "remove $archive and run this again" \
    "${unpack[@]}" "$archive" "$LAMMPS_SOURCE_DIR" "${LAMMPS_PARTS[@]}"
}

# What a build depends on, as one short word
build_key() {
  {
    printf '%s\n' "$LAMMPS_SOURCE_DIR" "${LAMMPS_CMAKE_FLAGS[@]}" "${CXX:-}" "${CXXFLAGS:-}"
    "${CXX:-c++}" --version
    mpicxx --version
    mpicxx -show
  } 2>&1 | sha256sum | cut -c 1-10
}

configure_and_build_lammps() {
  local log=$ALEISPH_CACHE/log/${LAMMPS_BUILD_DIR##*/}
  lammps_launcher "$ALEISPH_CACHE"
  if [ ! -f "$LAMMPS_BUILD_DIR/build.ninja" ]; then
    run_step "configuring LAMMPS" "$log-configure.log" \
      "remove $LAMMPS_BUILD_DIR and run this again; the log names what cmake did not find" \
      cmake -G Ninja -S "$LAMMPS_SOURCE_DIR/cmake" -B "$LAMMPS_BUILD_DIR" "${LAMMPS_CMAKE_FLAGS[@]}"
  fi
  run_step "building LAMMPS (about 8 minutes of one core, once)" "$log-build.log" \
    "run this again: it goes on where it stopped. If the compiler was killed, memory was short: \
set ALEISPH_JOBS=1" \
    cmake --build "$LAMMPS_BUILD_DIR" -j "$ALEISPH_JOBS"
  date >"$LAMMPS_BUILD_DIR/complete"
}

use_own_build() {
  [ -z "${ALEISPH_LAMMPS:-}" ] ||
    die "LAMMPS_BUILD_DIR and ALEISPH_LAMMPS are both set: unset one of them"
  [ -n "${LAMMPS_SOURCE_DIR:-}" ] || die "LAMMPS_BUILD_DIR is set: set LAMMPS_SOURCE_DIR, too"
}

own_source() {
  [ -f "$LAMMPS_SOURCE_DIR/src/version.h" ] ||
    die "LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR has no src/version.h: not a LAMMPS source tree"
  LAMMPS_BUILD_DIR=$ALEISPH_CACHE/build-own-$(build_key)
  configure_and_build_lammps    # always: the user may have changed something
}

released_source() {
  local version=${ALEISPH_LAMMPS:-20250204}
  LAMMPS_SOURCE_DIR=$ALEISPH_CACHE/lammps-$version
  LAMMPS_BUILD_DIR=$ALEISPH_CACHE/build-$version-$(build_key)
  [ ! -f "$LAMMPS_BUILD_DIR/complete" ] || return 0
  with_lock "$ALEISPH_CACHE/lock" fetch_and_build "$version"
}

fetch_and_build() {
  [ ! -f "$LAMMPS_BUILD_DIR/complete" ] || return 0    # another caller was faster
  fetch_lammps "$1"
  configure_and_build_lammps
}

# Sets and exports LAMMPS_SOURCE_DIR and LAMMPS_BUILD_DIR; instant if nothing is to be done
prepare_lammps() {
  if [ -n "${LAMMPS_BUILD_DIR:-}" ]; then
    use_own_build
  elif [ -n "${LAMMPS_SOURCE_DIR:-}" ]; then
    with_lock "$ALEISPH_CACHE/lock" own_source
  else
    released_source
  fi
  export LAMMPS_SOURCE_DIR LAMMPS_BUILD_DIR
}
