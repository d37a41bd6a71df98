#!/usr/bin/env bash
# ci/check-includes catches what is planted, at its line, and nothing else.
set -euo pipefail
ci=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/emulator/{core,optics,stray} "$tree/reports"
cp "$ci/../emulator/README.md" "$tree/emulator/"

cat >"$tree/emulator/optics/good.cpp" <<'END'
#include <vector>
#include "emulator/core/angle.hpp"
#include "emulator/optics/good.hpp"
END
"$ci/check-includes" "$tree"

echo '// nothing' >"$tree/emulator/core/bad.hpp"
echo '#include "emulator/optics/good.hpp"' >>"$tree/emulator/core/bad.hpp"
echo '#include "good.hpp"' >"$tree/emulator/optics/relative.cpp"
echo '  # include <reports/page.hpp>' >"$tree/emulator/optics/sideways.cpp"
echo '#include "emulator/app/main.hpp"' >"$tree/reports/upward.cpp"
echo '' >"$tree/emulator/stray/stray.cpp"

if found=$("$ci/check-includes" "$tree"); then
  echo "the planted includes were not caught"
  exit 1
fi
expected='emulator/core/bad.hpp:2: core may not include optics
emulator/optics/relative.cpp:1: write the path from the top folder
emulator/optics/sideways.cpp:1: optics may not include reports
emulator/stray/stray.cpp:1: module is not in emulator/README.md
reports/upward.cpp:1: reports may not include app'
diff <(cut -d: -f1-3 <<<"$found") - <<<"$expected"
