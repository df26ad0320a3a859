#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Displays come and go, and nodes die, return with another scene and flood their topics, many times
# over. Fails where a display crashes, shows what is no more or leaves an object of Ogre behind; says
# what memory was taken.
# usage: scripts/soak_displays.sh [--cycles N] [DISPLAY ...]
#   DISPLAY      canopy crowd forest grass wind; all of them if none is given
#   --cycles N   500 if not given
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

cycles=500
if [ "${1:-}" = --cycles ]; then cycles=$2; shift 2; fi
displays=("$@")
[ $# -gt 0 ] || displays=(canopy crowd forest grass wind)

use_space "$BUILD/devel"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VEGETATION_SIM_CYCLES=$cycles GTEST_FILTER='*LeavesNothingBehind:*Returns'
for display in "${displays[@]}"; do
  say "$display: $cycles cycles"
  sed "s/time-limit=\"[0-9]*\"/time-limit=\"7200\"/" \
    "$ROOT/test/rviz/${display}_display.test" >"$work/$display.test"
  rostest --text --pkgdir="$ROOT" --package=vegetation_sim "$work/$display.test" >"$work/log" 2>&1 ||
    { cat "$work/log"; fail "$display"; }
  grep -E 'cycles:|OK \]' "$work/log"
done
