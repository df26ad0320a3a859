#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Builds the core and the golden test with several compilers, levels of optimisation and processors,
# and runs every shared scene on every instruction set with 1 to 16 threads.
# usage: scripts/test_matrix.sh [PART ...]   all parts if none is given:
#   gcc_O2 clang_O2 gcc_O0 clang_O0          this processor
#   arm64_gcc arm64_clang arm64_scalar       ARM64, in qemu; with NEON, and without vectors
# Prints a row for each part: runs whose hashes and number are those of test/golden/golden.yaml, and
# the others. The exit code is 0 if all are equal. Needs ninja and, for its parts, clang, and
# g++-aarch64-linux-gnu and qemu-user; libraries for ARM64 are unpacked into build/matrix/arm64,
# without installing them. Takes hours on two cores.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
MATRIX=$BUILD/matrix
ARM=$MATRIX/arm64

# usage: unpack_libraries   Fetches Debian's libraries for ARM64. The private state of apt leaves
# this machine as it is.
unpack_libraries() {
  [ ! -e "$ARM/complete" ] || return 0
  say "Fetching libraries for ARM64 into $ARM"
  rm -rf "$ARM"
  mkdir -p "$ARM"/apt/{state/lists,cache/archives}/partial "$ARM/root"
  : >"$ARM/apt/status"
  cat >"$ARM/apt/apt.conf" <<CONF
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Install-Recommends "false";
Dir::State "$ARM/apt/state";
Dir::State::status "$ARM/apt/status";
Dir::Cache "$ARM/apt/cache";
CONF
  APT_CONFIG=$ARM/apt/apt.conf apt-get -qq update
  APT_CONFIG=$ARM/apt/apt.conf apt-get -qq -y --download-only install libeigen3-dev libgtest-dev \
    libhwy-dev libpng-dev libstdc++-12-dev libyaml-cpp-dev
  local package link
  for package in "$ARM"/apt/cache/archives/*.deb; do dpkg-deb -x "$package" "$ARM/root"; done
  # Absolute links would lead out of the folder.
  while IFS= read -r link; do
    ln -sfr "$ARM/root$(readlink "$link")" "$link"
  done < <(find "$ARM/root" -type l -lname '/*')
  : >"$ARM/complete"
}

# usage: options_of PART   Prints the options of CMake, one a line.
options_of() {
  local compiler=g++ flags=-O2
  case $1 in
    clang_*) compiler=clang++ ;;
    arm64_clang) compiler=clang++ ;;
    arm64_*) compiler=aarch64-linux-gnu-g++ ;;
  esac
  [[ $1 != *_O0 ]] || flags=-O0
  [[ $1 != *_scalar ]] || flags+=' -DHWY_COMPILE_ONLY_SCALAR'
  printf '%s\n' "-DCMAKE_CXX_COMPILER=$compiler" "-DCMAKE_CXX_FLAGS=$flags"
  [[ $1 = arm64_* ]] || return 0
  printf '%s\n' -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 "-DCMAKE_SYSROOT=$ARM/root" \
    -DCMAKE_CXX_COMPILER_TARGET=aarch64-linux-gnu -DCMAKE_LIBRARY_ARCHITECTURE=aarch64-linux-gnu \
    -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY \
    -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY
}

build_part() {
  local part=$1 folder=$MATRIX/$1 options
  mapfile -t options < <(options_of "$part")
  ! command -v ccache >/dev/null || options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  mkdir -p "$folder"
  PKG_CONFIG_LIBDIR=$([[ $part != arm64_* ]] || echo "$ARM/root/usr/lib/aarch64-linux-gnu/pkgconfig") \
    cmake -S "$ROOT/test/golden" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=None \
    "${options[@]}" >"$folder/configure.log" 2>&1 || { tail -n 30 "$folder/configure.log" >&2; return 1; }
  cmake --build "$folder" --target golden_test >"$folder/build.log" 2>&1 ||
    { tail -n 30 "$folder/build.log" >&2; return 1; }
}

# usage: run_part PART THREADS   Runs the scenes in as many processes as there are cores.
run_part() {
  local part=$1 folder=$MATRIX/$1 program=("$MATRIX/$1/golden_test")
  local shares share start=$SECONDS pids=() ended=true
  [[ $part != arm64_* ]] || program=(qemu-aarch64 -L "$ARM/root" "${program[@]}")
  shares=$(nproc)
  for ((share = 0; share < shares; ++share)); do
    VEGETATION_SIM_GOLDEN_THREADS=$2 GTEST_TOTAL_SHARDS=$shares GTEST_SHARD_INDEX=$share \
      "${program[@]}" --gtest_filter='Scenes/Golden.*' >"$folder/run_$share.log" 2>&1 &
    pids+=($!)
  done
  for share in "${pids[@]}"; do wait "$share" || ended=false; done
  awk -v part="$part" -v threads="$2" -v seconds=$((SECONDS - start)) '
    /^\[       OK \]/ { ++equal; split($4, name, "[/.]"); n = split(name[4], words, "_"); sets[words[n - 2]] }
    /^\[  FAILED  \].*ms\)$/ { ++different; print }
    END { for (set in sets) all = all " " set
          printf "|%s|%s|%s|%d|%d| %d s\n", part, substr(all, 2), threads, equal, different, seconds
          exit different > 0 || equal == 0 }' "$folder"/run_*.log && $ended
}

# usage: threads_of PART   Code without optimisation and in qemu is slow.
threads_of() {
  case $1 in
    gcc_O2 | clang_O2) echo 1 2 4 8 16 ;;
    *) echo 1 4 ;;
  esac
}

parts=("$@")
[ $# -gt 0 ] || parts=(gcc_O2 clang_O2 gcc_O0 clang_O0 arm64_gcc arm64_clang arm64_scalar)
for part in "${parts[@]}"; do
  case $part in
    gcc_O[02] | clang_O[02]) ;;
    arm64_gcc | arm64_clang | arm64_scalar) unpack_libraries ;;
    *) fail "unknown part $part" ;;
  esac
done
say '|part|instruction sets|threads|equal|different|'
failed=0
for part in "${parts[@]}"; do
  { build_part "$part" && run_part "$part" "$(threads_of "$part")"; } || failed=1
done
exit $failed
