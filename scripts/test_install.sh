#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Installs the build, draws a chart and runs scenarios from the installation, as nodes, as nodelets
# and, if the displays are built, with every display in rviz, and removes the installation again.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

# The script restarts itself without the environment, which may name the build folder.
if [ "${1:-}" != --clean ]; then
  exec env -i HOME="$HOME" PATH="$PATH" BUILD="$BUILD" "$0" --clean
fi

# The installation is removed at the end, because roslaunch would find every file twice if build/
# lies in the source tree.
INSTALLED=$BUILD/install
. "$ROOT/scripts/launching.sh"
example_pid=
trap 'stop_process "$example_pid"; stop_process "$launch_pid"; stop_process "$display_pid"; rm -rf "$WORK" "$INSTALLED"' EXIT
rm -rf "$INSTALLED"
cmake --install "$BUILD" >"$WORK/install.log"
use_space "$INSTALLED"

[ "$(rospack find vegetation_sim)" = "$INSTALLED/share/vegetation_sim" ] || fail 'rospack finds another copy of the package'
hosts=(nodelet)
[ ! -e "$DEVEL/lib/libvegetation_sim_rviz.so" ] || hosts+=(rviz)
for host in "${hosts[@]}"; do
  description=$(rospack plugins --attrib=plugin "$host" | sed -n 's/^vegetation_sim //p')
  [ -e "$description" ] || fail "no plugin description for $host"
  for library in $(sed -n 's/.*<library path="\([^"]*\)".*/\1/p' "$description"); do
    [ -e "$INSTALLED/$library.so" ] || [ -e "$INSTALLED/lib/$(basename "$library").so" ] ||
      fail "$description names $library, which is not installed"
  done
done
for file in "$INSTALLED"/lib/*.so "$INSTALLED"/lib/vegetation_sim/*; do
  ! ldd "$file" | grep -E "not found|$DEVEL" || fail "$file lacks a library"
done

# Another package must be able to include every installed header and link the libraries.
(cd "$INSTALLED/include" && find vegetation_sim -name '*.h' -printf '#include <%p>\n' | sort) >"$WORK/consumer.cpp"
echo 'int main() { return vegetation_sim::forest::ForestReplica().ready() ? 1 : 0; }' >>"$WORK/consumer.cpp"
# shellcheck disable=SC2046
g++ -std=c++17 -I"$INSTALLED/include" $(pkg-config --cflags eigen3 roscpp) "$WORK/consumer.cpp" -o "$WORK/consumer" \
  -L"$INSTALLED/lib" -lvegetation_sim_ros -lvegetation_sim_core $(pkg-config --libs roscpp yaml-cpp) \
  >"$WORK/consumer.log" 2>&1 && "$WORK/consumer" ||
  fail "a program of another package: $(tail -n 20 "$WORK/consumer.log")"

rosrun vegetation_sim charts --quick --only grass_ladder --out "$WORK/charts" >"$WORK/charts.log" 2>&1 ||
  fail "charts: $(cat "$WORK/charts.log")"

rosrun vegetation_sim export_forest package://vegetation_sim/config/scenarios/single_tree.yaml "$WORK/model"
python3 -c 'import sys, xml.etree.ElementTree as e; assert len(e.parse(sys.argv[1]).findall("model/link")) == 1' "$WORK/model/model.sdf" ||
  fail 'the exported model is not an SDF file of one tree'
mkdir -p "$WORK/taken/model.sdf"
! rosrun vegetation_sim export_forest package://vegetation_sim/config/scenarios/single_tree.yaml "$WORK/taken" 2>"$WORK/taken.log" ||
  fail 'a model was written over a folder'
! ls "$WORK"/taken/*.part 2>/dev/null || fail 'a rejected model leaves a partial file'

# The examples are built as other packages would be.
for example in "$ROOT"/examples/*/; do
  name=$(basename "$example")
  { cmake -G Ninja -S "$example" -B "$WORK/$name" -DCMAKE_PREFIX_PATH="$INSTALLED" \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 && cmake --build "$WORK/$name"; } >"$WORK/example.log" 2>&1 ||
    fail "the example $name: $(tail -n 20 "$WORK/example.log")"
done

# usage: run_example NAME TEXT. Runs an example until it prints the text.
run_example() {
  "$WORK/$1/devel/lib/$1/$1"* >"$WORK/$1.out" 2>&1 &
  example_pid=$!
  wait_until 60 "the output '$2' of $1" grep -q "$2" "$WORK/$1.out"
  stop_process "$example_pid"
}

# Succeeds if the map of planner_map has people (100) and grass, which costs less.
has_people_and_grass() {
  timeout 10 rostopic echo -n 1 -p /planner_map/data >"$WORK/map.csv" &&
    python3 -c 'import re, sys; c = set(map(int, re.findall(r"\d+", open(sys.argv[1]).read().split("\n")[1]))); sys.exit(not (100 in c and any(0 < v < 100 for v in c)))' "$WORK/map.csv"
}

start_launch demo.launch scenario:=single_tree rviz:=false
run_example follow_branch 'tip of branch 20'
run_example arm_pulls 'released branch'
stop_process "$launch_pid"

start_launch demo.launch scenario:=crowd rviz:=false
"$WORK/planner_map/devel/lib/planner_map/planner_map.py" >"$WORK/planner_map.out" 2>&1 &
example_pid=$!
# The map has people (100) among grass, which costs less.
wait_until 60 'a map with people and grass' has_people_and_grass
stop_process "$example_pid"
stop_process "$launch_pid"

for nodelets in false true; do
  start_launch demo.launch scenario:=crowd lidar:=true rviz:=false nodelets:=$nodelets
  wait_until 60 'a message on wind' topic_flows /wind
  wait_until 60 'a message on forest/state' topic_flows /forest/state
  wait_until 60 'a message on lidar/report' topic_flows /lidar/report
  check_launch
  stop_process "$launch_pid"
done

[ "${hosts[-1]}" = rviz ] || exit 0  # the nodes are built alone
# A display of this package publishes the view. rviz reports in its log which class could not be
# loaded.
start_display
start_launch demo.launch scenario:=demo rviz_args:=--disable-anti-aliasing
wait_until 60 'the rviz window' rviz_window
wait_until 60 'a message on viewer' topic_flows /viewer
check_launch
! grep -rh 'failed to load' "$LOG" "$ROS_LOG_DIR" || fail 'rviz cannot load a display'
