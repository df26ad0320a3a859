#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Measures which lines and branches of the core, of ros and of the nodes the tests reach.
# usage: scripts/measure_coverage.sh [--nodes]
#   --nodes  runs the tests of the nodes too, which takes half an hour longer
# Needs g++ and gcovr. Branches that only an exception of a library takes are left out. The tables of
# all files are written to build/coverage/*.txt.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

[[ ${1:-} = @(|--nodes) ]] || fail "unknown option $1; known is --nodes"
export BUILD=$ROOT/build/coverage DEVEL=$ROOT/build/coverage/devel
tests=(canopy core crowd dynamics forest fuzz golden grass reference ros sensors terrain tree wind)

mkdir -p "$BUILD"
launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S "$ROOT" -B "$BUILD" -G Ninja -DCMAKE_BUILD_TYPE=None \
  '-DCMAKE_CXX_FLAGS=-O1 --coverage -fprofile-update=atomic' \
  -Dvegetation_sim_RVIZ=OFF -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_DEVEL_PREFIX="$DEVEL" \
  "${launcher[@]}" >"$BUILD/configure.log" 2>&1 || { tail -n 30 "$BUILD/configure.log" >&2; exit 1; }
cmake --build "$BUILD" --parallel "$(nproc)" --target all "${tests[@]/%/_test}" >"$BUILD/build.log" ||
  { tail -n 30 "$BUILD/build.log" >&2; exit 1; }
find "$BUILD" -name '*.gcda' -delete
use_space "$DEVEL"
if [ $# -eq 0 ]; then
  for name in "${tests[@]}"; do
    "$DEVEL/lib/vegetation_sim/${name}_test" --gtest_brief=1 >"$BUILD/$name.log" 2>&1 || say "$name failed"
  done
else
  cmake --build "$BUILD" --parallel 1 --target run_tests >"$BUILD/tests.log" 2>&1 || true
fi

# usage: report NAME FOLDER ...
report() {
  local name=$1 filters=() folder
  shift
  for folder in "$@"; do filters+=(--filter "$ROOT/src/$folder/" --filter "$ROOT/include/vegetation_sim/$folder/"); done
  gcovr --root "$ROOT" --object-directory "$BUILD" "${filters[@]}" --exclude-throw-branches \
    --exclude-unreachable-branches --txt "$BUILD/$name.txt" --json-summary "$BUILD/$name.json" "$BUILD" \
    >"$BUILD/gcovr.log" 2>&1 || { tail -n 5 "$BUILD/gcovr.log" >&2; return 1; }
  python3 -c 'import json, sys
all = json.load(open(sys.argv[2]))
print("%-6s %5.1f %% of %d lines, %5.1f %% of %d branches" % (sys.argv[1], all["line_percent"],
      all["line_total"], all["branch_percent"], all["branch_total"]))' "$name" "$BUILD/$name.json"
}
report core canopy core crowd dynamics forest grass reference sensors terrain tree wind
report ros ros
report nodes nodes
