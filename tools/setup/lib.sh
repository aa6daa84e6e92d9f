# shellcheck shell=bash
# SPDX-License-Identifier: GPL-2.0-only
# Messages, long steps with progress, and locks. Sourced, not run.
# Everything a person reads goes to stderr; stdout carries only results.

ALEISPH_CACHE=${ALEISPH_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/aleisph}

# Those that this process may use, whatever a user has set for the threads of a program
cores() { env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc; }

ALEISPH_JOBS=${ALEISPH_JOBS:-$(cores)}

say() { printf '==> %s\n' "$*" >&2; }
die() {
  printf 'aleisph: %s\n' "$*" >&2
  exit 1
}
have() { command -v "$1" >/dev/null 2>&1; }

# No ticker outlives the script, however it ends
trap 'jobs -p | xargs -r kill 2>/dev/null || true' EXIT

# The newest "[done/total]" that ninja wrote into a log, as "done/total (percent)"
step_progress() {
  local last
  last=$(tail -c 2000 "$1" 2>/dev/null | grep -o '\[[0-9]*/[0-9]*\]' | tail -n 1 | tr -d '[]')
  [ -n "$last" ] || return 0
  printf '%s (%d%%)' "$last" $((100 * ${last%/*} / ${last#*/}))
}

# Names a step that takes longer than a second and reports on it: on a terminal every second in
# place, in a log file every 30 s. The pause is bash's own read with a time limit, so that no child
# outlives the step.
progress_ticker() {
  local title=$1 log=$2 caller=$3 start=$SECONDS pause=30 never
  exec {never}<> <(:)
  read -r -t 1 -u "$never" || say "$title"
  [ -t 2 ] && pause=1
  while kill -0 "$caller" 2>/dev/null; do
    read -r -t "$pause" -u "$never" || true
    if [ -t 2 ]; then
      printf '\r    %s %ds\033[K' "$(step_progress "$log")" $((SECONDS - start)) >&2
    else
      printf '    %s %ds\n' "$(step_progress "$log")" $((SECONDS - start)) >&2
    fi
  done
}

# try_step TITLE LOG COMMAND...: output goes to LOG; the status is the command's
try_step() {
  local title=$1 log=$2 start=$SECONDS ticker rc=0
  shift 2
  mkdir -p "$(dirname "$log")"
  : >"$log"
  progress_ticker "$title" "$log" $$ &
  ticker=$!
  "$@" >>"$log" 2>&1 </dev/null || rc=$?
  kill "$ticker" 2>/dev/null || true
  wait "$ticker" 2>/dev/null || true
  if [ -t 2 ]; then printf '\r\033[K' >&2; fi
  [ $((SECONDS - start)) -lt 3 ] || say "  $((SECONDS - start)) s"
  return "$rc"
}

# run_step TITLE LOG ADVICE COMMAND...: the same; on failure shows the end of the log and stops
run_step() {
  local title=$1 log=$2 advice=$3 rc=0
  shift 3
  try_step "$title" "$log" "$@" || rc=$?
  [ "$rc" -ne 0 ] || return 0
  printf 'aleisph: failed (status %d): %s\n' "$rc" "$title" >&2
  printf '  the end of %s:\n' "$log" >&2
  tail -n 25 "$log" | sed 's/^/    /' >&2
  printf '  what to do: %s\n' "$advice" >&2
  exit 1
}

# with_lock FILE COMMAND...: one at a time; runs in this shell, so that it may set variables.
# Children inherit the lock: a build that survives its caller still keeps others out.
with_lock() {
  local file=$1 fd
  shift
  mkdir -p "$(dirname "$file")"
  exec {fd}>"$file"
  if ! flock -n "$fd"; then
    say "waiting for another aleisph that is building here ($file)"
    flock "$fd"
  fi
  "$@"
  exec {fd}>&-
}
