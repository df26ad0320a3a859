#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Installs missing dependencies, builds everything, and runs the tests and checks.
# usage: scripts/test.sh [--lint | --sanitize | --no-display]
#   --lint        runs only the static checks, clang-tidy included
#   --sanitize    runs only the core's tests under the address and undefined behaviour sanitizers
#   --no-display  tests the nodes alone, on a machine without rviz, Qt and OpenGL, and installs none
#                 of them
# clang-tidy and the sanitizers take more than half an hour together and run only with these options;
# MAINTAINING.md asks for them before a release.
# The last line counts test cases and checks; the exit code is 0 if none failed.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

part=${1:-all} with_display=true
case $part in
  all | --lint | --sanitize) ;;
  --no-display) part=all with_display=false ;;
  *) fail "unknown option $part; known are --lint, --sanitize and --no-display" ;;
esac

passed=0 failed=0 skipped=0
failures=()

# usage: check NAME COMMAND ... Runs one check and shows its output only if it fails.
check() {
  local name=$1 start=$SECONDS output
  shift
  if output=$("$@" 2>&1); then
    passed=$((passed + 1))
    printf 'ok      %s (%d s)\n' "$name" $((SECONDS - start))
  else
    failed=$((failed + 1))
    failures+=("$name")
    printf '%s\nFAILED  %s (%d s)\n' "$output" "$name" $((SECONDS - start))
  fi
}

run_tests() {
  say 'Unit tests and node tests'
  rm -rf "$BUILD/test_results"
  # Tests of libraries run side by side, those of nodes one at a time, because they need the machine
  # for themselves. Failures are in the results.
  local tests=run_tests_vegetation_sim
  {
    cmake --build "$BUILD" --parallel "$(nproc)" --target ${tests}_gtest ${tests}_roslaunch-check || true
    cmake --build "$BUILD" --parallel 1 --target ${tests}_rostest || true
  } >"$BUILD/tests.log" 2>&1
  local counts
  counts=$(python3 "$ROOT/scripts/count_tests.py" "$BUILD/test_results")
  read -r ok bad left <<<"$(tail -n 1 <<<"$counts")"
  head -n -1 <<<"$counts"
  passed=$((passed + ok)) failed=$((failed + bad)) skipped=$((skipped + left))
  [ "$bad" -eq 0 ] || failures+=("test cases, see $BUILD/tests.log")
}

lint() {
  say 'Checks of the code'
  local name names=(format catkin structure words docs api)
  [ $part = all ] || names+=(tidy)
  for name in "${names[@]}"; do check "lint $name" "$ROOT/scripts/lint.sh" $name; done
}

# usage: in_shares COMMAND ... Divides the tests of a suite among as many processes as there are
# cores.
in_shares() {
  local shares share pids=() bad=0
  shares=$(nproc)
  for ((share = 0; share < shares; ++share)); do
    GTEST_TOTAL_SHARDS=$shares GTEST_SHARD_INDEX=$share "$@" &
    pids+=($!)
  done
  for share in "${pids[@]}"; do wait "$share" || bad=1; done
  return $bad
}

sanitize() {
  say 'The core under sanitizers'
  local folder folders=(canopy core crowd dynamics forest grass sensors terrain tree wind)
  check 'sanitizers: build' "$ROOT/scripts/build.sh" --sanitize "${folders[@]/%/_test}"
  for folder in "${folders[@]}"; do
    check "sanitizers: $folder" in_shares timeout 2400 "$BUILD/sanitize/devel/lib/vegetation_sim/${folder}_test" --gtest_brief=1
  done
}

dependencies=(--checks)
$with_display || dependencies+=(--no-display)
"$ROOT/scripts/install_dependencies.sh" "${dependencies[@]}"
[ $part = --sanitize ] || "$ROOT/scripts/build.sh" all benches tests
[ $part != all ] || run_tests
[ $part = --sanitize ] || lint
[ $part != --sanitize ] || sanitize
[ $part != all ] || check 'a machine whose name does not resolve' "$ROOT/scripts/test_environment.sh"
[ $part != all ] || check 'packages of each system' "$ROOT/scripts/test_systems.sh"
[ $part != all ] || check 'runs from the install space' "$ROOT/scripts/test_install.sh"
[ $part != all ] || ! $with_display || check 'a series of pictures of the demo' "$ROOT/scripts/test_demo.sh"

[ $failed -eq 0 ] || printf 'FAILED  %s\n' "${failures[@]}"
printf '%d passed, %d failed, %d skipped\n' $passed $failed $skipped
[ $failed -eq 0 ] && [ $passed -gt 0 ]
