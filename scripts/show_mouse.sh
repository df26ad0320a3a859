#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Moves a real mouse over rviz on a virtual display: it grabs, drags and releases a branch, treads
# the grass and draws a gust with the panel. The script fails if the nodes do not react.
# usage: scripts/show_mouse.sh FOLDER    writes screenshots and services.log into FOLDER
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

[ $# -eq 1 ] || { printf 'usage: scripts/show_mouse.sh FOLDER\n' >&2; exit 2; }
mkdir -p "$1"
use_space "$DEVEL"
. "$ROOT/scripts/launching.sh"
trap 'stop_process "$launch_pid"; stop_process "$display_pid"; rm -rf "$WORK"' EXIT
trap 'exit 130' INT TERM
start_display
start_launch mouse.launch
wait_until 120 'the rviz window' rviz_window
wait_until 60 'a message on forest/state' topic_flows /forest/state
python3 "$ROOT/test/rviz/mouse/scripted_mouse.py" "$1"
check_launch
