#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Fuzzes the readers of messages and files with libFuzzer under the address and undefined behaviour
# sanitizers, and runs random scenarios.
# usage: scripts/fuzz.sh [SECONDS] [TARGET ...]   fuzzes each target, or all, as many at once as there
#                                                  are cores; 300 s each by default
#        scripts/fuzz.sh --scenarios [CASES]      runs random scenarios; 20000 by default
# Needs clang with libFuzzer (Debian: clang, libclang-rt-dev). New inputs are kept in
# build/fuzz/corpus. An input that crashes or exceeds a limit is written to build/fuzz/found; once it
# is mended, move it to test/fuzz/corpus/TARGET, which the tests read.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

run_scenarios() {
  "$ROOT/scripts/build.sh" fuzz_test
  VEGETATION_SIM_FUZZ_CASES=${1:-20000} "$DEVEL/lib/vegetation_sim/fuzz_test" --gtest_filter='RandomCase.*'
}

build_program() {
  local flags='-O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined,fuzzer-no-link'
  # ROS reads numbers where they lie, at any address.
  flags+=' -fno-sanitize=null,alignment,vptr,function -fno-sanitize-recover=all'
  say "Building the fuzz program in $FUZZ"
  mkdir -p "$FUZZ"
  cmake -S "$ROOT" -B "$FUZZ" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
    "-DCMAKE_CXX_FLAGS=$flags" -Dvegetation_sim_FUZZ=ON -Dvegetation_sim_RVIZ=OFF \
    -DCATKIN_ENABLE_TESTING=OFF -DPYTHON_EXECUTABLE=/usr/bin/python3 \
    "${launcher[@]}" >"$FUZZ/configure.log" 2>&1 || { tail -n 30 "$FUZZ/configure.log" >&2; exit 1; }
  cmake --build "$FUZZ" --parallel "$(nproc)" --target fuzz
}

# usage: fuzz_target SECONDS TARGET   prints executions, corpus and coverage
fuzz_target() {
  local seconds=$1 target=$2 log="$FUZZ/$2.log" status=ok
  mkdir -p "$FUZZ/corpus/$target" "$FUZZ/found"
  local arguments=("$FUZZ/corpus/$target" "$FUZZ/seeds/$target")
  [ ! -d "$ROOT/test/fuzz/corpus/$target" ] || arguments+=("$ROOT/test/fuzz/corpus/$target")
  # assimp does not end for some damaged files; its process is ended after 20 s.
  [ "$target" != mesh ] || arguments+=(-timeout=40)
  ASAN_OPTIONS=quarantine_size_mb=16 "$PROGRAM" --target="$target" -max_total_time="$seconds" \
    -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=256 -max_len=20000 -print_final_stats=1 -verbosity=1 \
    -artifact_prefix="$FUZZ/found/${target}_" "${arguments[@]}" >"$log" 2>&1 || status=FAILED
  awk -v name="$target" -v status=$status '
    / cov: / { for (i = 1; i <= NF; ++i) { if ($i == "cov:") edges = $(i + 1); if ($i == "corp:") corpus = $(i + 1) } }
    /number_of_executed_units/ { runs = $2 }
    /peak_rss_mb/ { rss = $2 }
    END { printf "%-7s %-14s %10d executions %6d edges, corpus %s, %d MB\n", status, name, runs, edges, corpus, rss }' "$log"
  [ $status = ok ] || grep -m 3 -E 'ERROR|SLOW|LARGE|terminate|what\(\)' "$log" || true
  [ $status = ok ]
}

# usage: fuzz_all TARGET ...   as many at once as there are cores
fuzz_all() {
  local target running=0 failed=0 logs=("${@/#/$FUZZ/}")
  for target in "$@"; do
    if [ "$running" -ge "$(nproc)" ]; then
      wait -n || failed=1
      running=$((running - 1))
    fi
    fuzz_target "$seconds" "$target" &
    running=$((running + 1))
  done
  for (( ; running > 0; --running)); do wait -n || failed=1; done
  awk '/number_of_executed_units/ { all += $2 } END { printf "%d executions of all targets\n", all }' \
    "${logs[@]/%/.log}"
  return $failed
}

case ${1:-} in
  --scenarios)
    shift
    run_scenarios "$@"
    exit
    ;;
  --*) fail "unknown option $1; known is --scenarios" ;;
esac
FUZZ=$BUILD/fuzz
PROGRAM=$FUZZ/devel/lib/vegetation_sim/fuzz
launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
seconds=${1:-300}
[[ $seconds =~ ^[0-9]+$ ]] || fail "'$seconds' is no number of seconds"
[ $# -eq 0 ] || shift
build_program
targets=("$@")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <("$PROGRAM" --list)
"$PROGRAM" --seeds="$FUZZ/seeds"
fuzz_all "${targets[@]}"
