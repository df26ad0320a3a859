#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Creates and destroys displays many times, and lets nodes die, return with another scene and flood
# their topics. It fails if a display crashes, shows stale objects, leaves an object of Ogre behind,
# or if memory grows. It prints and draws the growth.
# usage: scripts/soak_displays.sh [--cycles N] [--reloads N] [--sanitize] [--chart FILE.png]
# [DISPLAY ...]
#   DISPLAY      canopy, crowd, forest, grass, wind or landscape (all five in one rviz);
#                default: all of them, with --sanitize also tools (the tools and the panel)
#   --cycles N   displays created and destroyed: default 500, with --sanitize 40
#   --reloads N  restarts of the node: default 100, with --sanitize 20
#   --sanitize   runs the whole test of each display, built into build/sanitize with the address
#                and undefined behaviour sanitizers, which also report leaks of our own code
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

cycles= reloads= sanitize=false chart=
while [[ ${1:-} == --* ]]; do
  case $1 in
    --sanitize) sanitize=true ;;
    --cycles | --reloads | --chart)
      printf -v "${1#--}" %s "${2:?$1 requires a value}"
      shift
      ;;
    *) fail "unknown option $1" ;;
  esac
  shift
done
displays=("$@")
[ $# -gt 0 ] || displays=(canopy crowd forest grass wind landscape)
[ $# -gt 0 ] || ! $sanitize || displays+=(tools)
for i in "${!displays[@]}"; do [[ ${displays[i]} = @(landscape|tools) ]] || displays[i]+=_display; done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=
if $sanitize; then
  targets=("${displays[@]/%/_rostest}")
  [[ " ${displays[*]} " != *' tools '* ]] || targets+=(forest_animator wind_broadcaster)
  [[ " ${displays[*]} " != *' landscape '* ]] ||
    targets+=(agent_crowd canopy_animator forest_animator grass_field wind_broadcaster)
  "$ROOT/scripts/build.sh" --sanitize "${targets[@]}"
  DEVEL=$BUILD/sanitize/devel
  prefix=$ROOT/test/rviz/rigs/sanitized.sh
fi
use_space "$DEVEL"
$sanitize || export GTEST_FILTER='*LeavesNothingBehind:*Returns'
if $sanitize; then : "${cycles:=40}" "${reloads:=20}"; else : "${cycles:=500}" "${reloads:=100}"; fi
export VEGETATION_SIM_CYCLES=$cycles VEGETATION_SIM_RELOADS=$reloads
for display in "${displays[@]}"; do
  say "${display%_display}: $cycles cycles, $reloads reloads"
  export VEGETATION_SIM_MEMORY=$work/${display%_display}.csv
  sed "s/time-limit=\"[0-9]*\"/time-limit=\"7200\"/; s|with_display.sh|& $prefix|" \
    "$(find "$ROOT/test/rviz" -name "$display.test")" >"$work/$display.test"
  rostest --text --pkgdir="$ROOT" --package=vegetation_sim "$work/$display.test" >"$work/log" 2>&1 ||
    { cat "$work/log"; fail "$display"; }
  grep 'OK \]' "$work/log"
done
$sanitize || python3 "$ROOT/scripts/soak_chart.py" "$work" "${chart:-$work/memory.png}"
