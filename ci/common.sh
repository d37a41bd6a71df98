# Functions of the scripts in this folder. Source it; do not run it.
# shellcheck shell=bash

# shellcheck disable=SC2034  # used by the scripts that source this file
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
script=$(basename "$0")

# say TEXT...: one line of progress.
say() { printf '== %s\n' "$*" >&2; }

# die TEXT...: says why on stderr and ends the script.
die() {
  printf 'ci/%s: %s\n' "$script" "$*" >&2
  exit 1
}

# quietly COMMAND...: its output is seen only if it fails.
quietly() {
  local output
  if ! output=$("$@" 2>&1); then
    printf '%s\n' "$output" >&2
    return 1
  fi
}

# build PRESET [TARGET]: a bar that moves on a terminal, only what went wrong in a log.
build() {
  local arguments=(--build --preset "$1")
  if (($# > 1)); then arguments+=(--target "$2"); fi
  if [[ ! -t 1 ]]; then arguments+=(-- --quiet); fi
  cmake "${arguments[@]}"
}

# ctest_counts: reads the output of ctest and prints "PASSED FAILED"; nothing if it has no summary.
ctest_counts() {
  sed -n -E 's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+).*/\1 \2/p' |
    awk '{ print $2 - $1, $1 }'
}
