#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Displays come and go, and nodes die, return with another scene and flood their topics, many times
# over. Fails where a display crashes, shows what is no more, leaves an object of Ogre behind, or,
# with --sanitizer, writes or frees wrongly or leaks; says what memory was taken.
# usage: scripts/soak_displays.sh [--cycles N] [--sanitizer] [DISPLAY ...]
#   DISPLAY      canopy crowd forest grass wind; all of them if none is given
#   --cycles N   500 if not given
#   --sanitizer  under the address sanitizer's allocator (libasan), leaks of others left out
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

cycles=500 watched=
while [[ ${1:-} == --* ]]; do
  case $1 in
    --cycles) cycles=$2; shift ;;
    --sanitizer)
      watched="env LD_PRELOAD=$(gcc -print-file-name=libasan.so) ASAN_OPTIONS=new_delete_type_mismatch=0"
      watched+=" LSAN_OPTIONS=suppressions=$ROOT/test/rviz/leaks_of_others.txt:print_suppressions=0"
      ;;
    *) fail "unknown option $1" ;;
  esac
  shift
done
displays=("$@")
[ $# -gt 0 ] || displays=(canopy crowd forest grass wind)

use_space "$BUILD/devel"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VEGETATION_SIM_CYCLES=$cycles GTEST_FILTER='*LeavesNothingBehind:*Returns'
for display in "${displays[@]}"; do
  say "$display: $cycles cycles"
  sed "s/time-limit=\"[0-9]*\"/time-limit=\"7200\"/; s|with_display.sh|& $watched|" \
    "$ROOT/test/rviz/${display}_display.test" >"$work/$display.test"
  rostest --text --pkgdir="$ROOT" --package=vegetation_sim "$work/$display.test" >"$work/log" 2>&1 ||
    { cat "$work/log"; fail "$display"; }
  grep -E 'cycles:|OK \]' "$work/log"
done
