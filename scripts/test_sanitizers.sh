#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs tests under sanitizers. Takes more than an hour for each part on two cores.
# usage: scripts/test_sanitizers.sh address   ros, all nodes and the displays under the address and
#                                             undefined behaviour sanitizers; test.sh --sanitize
#                                             checks the core
#        scripts/test_sanitizers.sh thread    under the thread sanitizer: core suites that use
#                                             threads, the shared scenes with 1 to 16 threads, nodes
#                                             that end within callbacks, and all nodes as nodelets
#                                             with eight threads, loaded and unloaded 1002 times
# Prints a row for each test. The exit code is 0 if no sanitizer reported anything. A test that fails
# without a report, because programs are many times slower here, is marked but does not count.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

part=${1:-} failed=0
[[ $part = @(address|thread) ]] || fail "unknown part '$part'; known are address and thread"
folder=$BUILD/$([ "$part" = address ] && echo sanitize || echo races)
reports=$folder/reports
common="log_path=$reports/report:log_exe_name=1"
export ASAN_OPTIONS=$common:detect_leaks=0:new_delete_type_mismatch=0
export UBSAN_OPTIONS=$common:print_stacktrace=1
export TSAN_OPTIONS=$common:suppressions=$ROOT/test/thread_sanitizer.txt

# usage: run_test NAME COMMAND ...   Prints what the sanitizers reported during the command.
run_test() {
  local name=$1 start=$SECONDS count result=passed
  shift
  rm -rf "$reports" && mkdir -p "$reports"
  "$@" </dev/null >"$folder/$name.log" 2>&1 || result='failed, see its log'
  ! grep -qE 'FAILURES: [1-9]|ERRORS: [1-9]|RESULT: FAIL' "$folder/$name.log" || result='failed, see its log'
  # Tests of snapshots kill nodes.
  ! grep 'process has died' "$folder/$name.log" | grep -qv 'exit code -9' || result='failed, see its log'
  count=$(cat "$reports"/* 2>/dev/null | grep -cE 'ERROR: AddressSanitizer|runtime error:|WARNING: ThreadSanitizer|Sanitizer: CHECK failed' || true)
  [ "$count" -eq 0 ] || cp -r "$reports" "$folder/reports_$name"
  [ "$count" -eq 0 ] || failed=1
  printf '%-28s %3d reports, %s (%d s)\n' "$name" "$count" "$result" $((SECONDS - start))
}

# usage: run_rostest FILE   In a network of its own, no node of another run answers. The manager of
# nodelets is not built with the sanitizer, so the sanitizer's library is loaded before it.
run_rostest() {
  local first=
  [ "$part" = thread ] || ! grep -q 'nodelet' "$1" || first=$(c++ -print-file-name=libasan.so)
  run_test "$(basename "$1" .test)" unshare --user --map-root-user --net bash -c \
    "ip link set lo up; LD_PRELOAD='$first' exec rostest --text '$1'"
}

run_program() { run_test "$1" "$folder/devel/lib/vegetation_sim/$1" --gtest_brief=1; }

if [ "$part" = address ]; then
  "$ROOT/scripts/build.sh" --sanitize all tests
  use_space "$folder/devel"
  for name in ros_test fuzz_test rviz_test; do run_program $name; done
  while IFS= read -r file; do run_rostest "$file"; done < <(find "$ROOT"/test/{nodes,ros,rviz,python} -name '*.test' | sort)
else
  "$ROOT/scripts/build.sh" --races core_test crowd_test forest_test sensors_test golden_test \
    node_base_test nodelet_loading_test vegetation_sim_nodelets
  use_space "$folder/devel"
  for name in core_test crowd_test forest_test sensors_test; do run_program $name; done
  export VEGETATION_SIM_GOLDEN_THREADS='1 2 4 8 16'
  run_program golden_test
  export VEGETATION_SIM_NODELET_ROUNDS=167 VEGETATION_SIM_TIME_LIMIT=7200
  for name in node_base nodelet_loading; do run_rostest "$ROOT/test/nodes/base/$name.test"; done
fi
exit $failed
