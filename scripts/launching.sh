# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Scripts that start a launch file source this file. Each launch gets its own ROS master and leaves
# no process behind. WORK is a temporary folder and $WORK/launch.log (LOG) has the output of the
# launch. start_display starts a virtual display; display_pid is its process id.
WORK=$(mktemp -d)
LOG=$WORK/launch.log
launch_pid= display_pid=

descendants() {
  local child
  for child in $(ps -o pid= --ppid "$1"); do
    descendants "$child"
    echo "$child"
  done
}

# Ends a process and its children with SIGTERM and, after 30 s, with SIGKILL.
stop_process() {
  local pid=$1 family waited=0
  [ -n "$pid" ] && kill -0 "$pid" 2>/dev/null || return 0
  family=$(descendants "$pid")
  kill -TERM "$pid" 2>/dev/null || true
  while kill -0 "$pid" 2>/dev/null && [ $waited -lt 300 ]; do
    sleep 0.1
    waited=$((waited + 1))
  done
  # shellcheck disable=SC2086
  kill -KILL "$pid" $family 2>/dev/null || true
}

# usage: start_launch FILE [ARGUMENT ...]. Starts a launch file of this package. ROS must be in the
# environment.
start_launch() { start_roslaunch vegetation_sim "$@"; }

# usage: start_roslaunch [PACKAGE] FILE [ARGUMENT ...]
start_roslaunch() {
  local port
  port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI=http://127.0.0.1:$port ROS_IP=127.0.0.1
  unset ROS_HOSTNAME
  export ROS_HOME=$WORK/ros ROS_LOG_DIR=$WORK/ros/log
  roslaunch -p "$port" "$@" >"$LOG" 2>&1 &
  launch_pid=$!
}

# usage: wait_until SECONDS WHAT COMMAND ... Waits until the command succeeds. Fails if the launch
# ends or the time is over; WHAT names the condition in the error.
wait_until() {
  local deadline=$((SECONDS + $1)) what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do
    check_launch
    [ $SECONDS -lt $deadline ] || give_up "$what did not happen in time"
    sleep 0.2
  done
}

topic_flows() { timeout 10 rostopic echo -n 1 --noarr "$1"; }

# Fails unless every node still runs.
check_launch() {
  kill -0 "$launch_pid" 2>/dev/null || give_up 'the launch ended unexpectedly'
  ! grep -q 'has died\|REQUIRED process' "$LOG" || give_up 'a node died'
}

give_up() {
  tail -n 40 "$LOG" >&2
  grep -A 3 'has died' "$LOG" >&2 || true
  fail "$*"
}

# Prints the id of rviz's window on the virtual display.
rviz_window() { xdotool search --onlyvisible --name 'RViz$' | head -n 1 | grep .; }

# SCREEN is the size of the virtual display, 1280x900 if it is not set.
start_display() {
  # Xvfb writes the number of its display when it is ready.
  Xvfb -displayfd 3 -screen 0 "${SCREEN:-1280x900}x24" +extension GLX -nolisten tcp \
    3>"$WORK/display" >"$WORK/xvfb.log" 2>&1 &
  display_pid=$!
  local deadline=$((SECONDS + 30))
  until [ -s "$WORK/display" ]; do
    [ $SECONDS -lt $deadline ] && kill -0 $display_pid || fail "no virtual display: $(cat "$WORK/xvfb.log")"
    sleep 0.1
  done
  DISPLAY=:$(cat "$WORK/display")
  # Without rasteriser threads: on a busy machine those of Mesa 22.3 crashed in two of about thirty
  # starts of rviz, while it swapped buffers.
  export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=${LP_NUM_THREADS:-0} QT_QPA_PLATFORM=xcb
  if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
    mkdir -m 700 "$WORK/runtime"
    export XDG_RUNTIME_DIR=$WORK/runtime
  fi
}

# Builds all that rviz_frames needs, and starts a display that draws on all cores. At the end of the
# script the launch and the display end.
prepare_frames() {
  "$ROOT/scripts/build.sh" all benches
  use_space "$DEVEL"
  trap 'stop_process "$launch_pid"; stop_process "$display_pid"; rm -rf "$WORK"' EXIT
  trap 'exit 130' INT TERM
  LP_NUM_THREADS=$(nproc) start_display
}
