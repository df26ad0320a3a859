#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Builds the package into build/ and devel/, or into $BUILD and $BUILD/devel. Repeated builds compile
# only what changed.
# usage: scripts/build.sh [--developer | --sanitize | --races] [TARGET ...]
#   --developer  makes warnings in the package's own code errors with any compiler
#   --sanitize   builds into build/sanitize with the address and undefined behaviour sanitizers
#   --races      builds into build/races with the thread sanitizer
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

options=()
# Warnings are errors with the compiler of Debian 12 in any case: every change is tested with it, and
# the demo and the tests share objects only if they have the same flags.
[ "$(c++ -dumpversion)" != 12 ] || options=(-Dvegetation_sim_DEVELOPER=ON)
case ${1:-} in
  --developer)
    options=(-Dvegetation_sim_DEVELOPER=ON)
    shift
    ;;
  --sanitize)
    BUILD=$BUILD/sanitize
    DEVEL=$BUILD/devel
    # A null or misaligned access stops the program in any case, and checking for both would double
    # the compile time.
    options=(-DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=-O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize=null,alignment -fno-sanitize-recover=all")
    shift
    ;;
  --races)
    BUILD=$BUILD/races
    DEVEL=$BUILD/devel
    options=(-DCMAKE_BUILD_TYPE=None '-DCMAKE_CXX_FLAGS=-O1 -g1 -fno-omit-frame-pointer -fsanitize=thread')
    shift
    ;;
esac
targets=()
for target in "$@"; do targets+=(--target "$target"); done

# Compiling a file takes as long as some forty other steps, such as generating a message.
COMPILE_WORK=40

# usage: work_to_do TARGET ... Prints the work in all steps that ninja will run. A dry run would end
# before the first one if its file were the one that CMake may have to make anew.
work_to_do() {
  cp "$BUILD/build.ninja" "$BUILD/steps.ninja"
  ninja -C "$BUILD" -f steps.ninja -n "$@" |
    awk -v work="$COMPILE_WORK" '/Building C/ { all += work; next } { ++all } END { print all + 1 }'
}

# Rewrites ninja's lines "DONE TOTAL SECONDS STEP" with the percentage and the time that the rest
# takes if its work is as fast as that before. A terminal shows the present line only.
show_progress() {
  local line finished=0 total=$1 minutes step work end='\n'
  [ ! -t 1 ] || end='\033[K\r'
  while IFS= read -r line; do
    if [[ $line =~ ^@([0-9]+)\ ([0-9]+)\ ([0-9]+)[.0-9]*\ (.*) ]]; then
      step=${BASH_REMATCH[4]} work=1
      [[ $step != Building\ C* ]] || work=$COMPILE_WORK
      finished=$((finished + work)) total=$((finished > total ? finished : total))
      minutes=$(((BASH_REMATCH[3] * (total - finished) / finished + 30) / 60))
      # The text of a step without a name is its command.
      [[ $step = cd\ * ]] ||
        printf "[%3d %%, %d min left] %.80s$end" $((100 * finished / total)) $minutes "$step"
    else
      printf '%s\n' "$line"
    fi
  done
}

# ccache accepts precompiled headers only with these settings.
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime

say "Building in $BUILD"
if [ ! -e "$BUILD/CMakeCache.txt" ]; then
  options+=(-G Ninja)
  command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
mkdir -p "$BUILD"
cmake -S "$ROOT" -B "$BUILD" "${options[@]}" -DPYTHON_EXECUTABLE=/usr/bin/python3 \
  -DCATKIN_DEVEL_PREFIX="$DEVEL" \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_INSTALL_PREFIX="$BUILD/install" \
  >"$BUILD/configure.log" 2>&1 || { tail -n 30 "$BUILD/configure.log" >&2; exit 1; }
work=$(work_to_do "$@")
NINJA_STATUS='@%f %t %e ' cmake --build "$BUILD" --parallel "$(nproc)" "${targets[@]}" |
  show_progress "$work"
