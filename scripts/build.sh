#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Builds the package into build/ (or $BUILD). Repeated builds compile only what changed.
# usage: scripts/build.sh [--developer | --sanitize] [TARGET ...]
#   --developer  makes warnings in the package's own code errors
#   --sanitize   builds into build/sanitize with the address and undefined behaviour sanitizers
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

options=()
case ${1:-} in
  --developer)
    options=(-Dvegetation_sim_DEVELOPER=ON)
    shift
    ;;
  --sanitize)
    BUILD=$BUILD/sanitize
    # A null or misaligned access stops the program in any case, and checking for both would double
    # the compile time.
    options=(-DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=-O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize=null,alignment -fno-sanitize-recover=all")
    shift
    ;;
esac
# A cache of compilers accepts precompiled headers only with these settings.
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime

targets=()
for target in "$@"; do targets+=(--target "$target"); done

say "Building in $BUILD"
if [ ! -e "$BUILD/CMakeCache.txt" ]; then
  options+=(-G Ninja)
  command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
mkdir -p "$BUILD"
cmake -S "$ROOT" -B "$BUILD" "${options[@]}" -DPYTHON_EXECUTABLE=/usr/bin/python3 \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_INSTALL_PREFIX="$BUILD/install" \
  >"$BUILD/configure.log" 2>&1 || { tail -n 30 "$BUILD/configure.log" >&2; exit 1; }
cmake --build "$BUILD" --parallel "$(nproc)" "${targets[@]}"
