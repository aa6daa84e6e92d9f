# shellcheck shell=bash
# SPDX-License-Identifier: GPL-2.0-only
# Debian packages that the set-up needs. Sourced, not run.

PACKAGES_BUILD=(cmake ninja-build g++ libopenmpi-dev openmpi-bin libeigen3-dev libhypre-dev libgtest-dev
  libpng-dev libjpeg62-turbo-dev zlib1g-dev
  python3 python3-numpy python3-matplotlib python3-yaml libopenblas-dev liblapack-dev xz-utils)
# makes a second build of LAMMPS (the in-tree test) cheap; nothing depends on it
PACKAGES_EXTRA=(ccache)

# Those of the named packages that dpkg does not know as installed
missing_packages() {
  local name installed
  # its status is that of a name it does not know
  installed=$( (dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' "$@" 2>/dev/null || true) |
    sed -n 's/^ii *//p')
  for name in "$@"; do
    grep -qx "$name" <<<"$installed" || printf '%s\n' "$name"
  done
}

apt_install() {
  local log=$ALEISPH_CACHE/log
  export DEBIAN_FRONTEND=noninteractive
  run_step "apt-get update" "$log/apt-update.log" \
    "check the network and the sources in /etc/apt, then run this again" \
    apt-get -o DPkg::Lock::Timeout=600 update
  run_step "apt-get install $*" "$log/apt-install.log" \
    "run 'apt-get install $*' by hand and read what it says" \
    apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends "$@"
}

# require_packages NAME...: installs what is missing as root, else says what to install
require_packages() {
  local missing
  [ -z "${ALEISPH_NO_INSTALL:-}" ] || return 0
  if ! have dpkg-query || ! have apt-get; then
    require_commands
    return 0
  fi
  mapfile -t missing < <(missing_packages "$@")
  [ "${#missing[@]}" -gt 0 ] || return 0
  if [ "$(id -u)" -eq 0 ]; then
    apt_install "${missing[@]}"
  else
    die "these packages are missing; install them and run this again:
  sudo apt-get update; sudo apt-get install ${missing[*]}
(or set ALEISPH_NO_INSTALL=1 if the programs come from elsewhere)"
  fi
}

# On other systems: name the programs that are missing and how they are called in Debian
require_commands() {
  local command missing=()
  for command in cmake ninja c++ mpicxx mpirun python3 xz; do
    have "$command" || missing+=("$command")
  done
  [ "${#missing[@]}" -eq 0 ] || die "this system has no apt-get; install by its own means: \
${missing[*]}, and the libraries Eigen 3, GoogleTest, OpenBLAS and LAPACK with their headers, and best hypre
(in Debian: ${PACKAGES_BUILD[*]})"
}

require_build_packages() {
  local extra=()
  if [ "$(id -u)" -eq 0 ]; then extra=("${PACKAGES_EXTRA[@]}"); fi
  require_packages "${PACKAGES_BUILD[@]}" "${extra[@]}"
}
