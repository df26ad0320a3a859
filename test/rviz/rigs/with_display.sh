#!/bin/bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs a command on its own virtual display.
set -e
folder=$(mktemp -d)
trap 'kill "$server" 2>/dev/null; rm -r "$folder"' EXIT
mkfifo "$folder/number"
Xvfb -displayfd 3 -screen 0 800x600x24 +extension GLX 3>"$folder/number" 2>"$folder/log" &
server=$!
read -r number <"$folder/number"
export DISPLAY=:$number LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=0 QT_X11_NO_MITSHM=1
"$@"
