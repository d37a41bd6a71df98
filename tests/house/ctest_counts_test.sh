#!/usr/bin/env bash
# ci/test counts what ctest says.
set -euo pipefail
# shellcheck source=ci/common.sh
source "$1/common.sh"

expect() {
  local found
  found=$(ctest_counts <<<"$1")
  [[ $found == "$2" ]] || { echo "of '$1': got '$found', expected '$2'" && exit 1; }
}
expect '100% tests passed, 0 tests failed out of 12' '12 0'
expect '92% tests passed, 1 tests failed out of 12' '11 1'
expect '0% tests passed, 3 tests failed out of 3' '0 3'
expect $'1/1 Test #1: prints "100% tests passed"\n\n50% tests passed, 1 tests failed out of 2\n\nTotal' '1 1'
expect 'No tests were found!!!' ''
