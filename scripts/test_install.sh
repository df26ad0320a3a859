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
[ ! -e "$BUILD/devel/lib/libvegetation_sim_rviz.so" ] || hosts+=(rviz)
for host in "${hosts[@]}"; do
  description=$(rospack plugins --attrib=plugin "$host" | sed -n 's/^vegetation_sim //p')
  [ -e "$description" ] || fail "no plugin description for $host"
  for library in $(sed -n 's/.*<library path="\([^"]*\)".*/\1/p' "$description"); do
    [ -e "$INSTALLED/$library.so" ] || [ -e "$INSTALLED/lib/$(basename "$library").so" ] ||
      fail "$description names $library, which is not installed"
  done
done
for file in "$INSTALLED"/lib/*.so "$INSTALLED"/lib/vegetation_sim/*; do
  ! ldd "$file" | grep -E "not found|$BUILD/devel" || fail "$file lacks a library"
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

# The example is built as another package would be.
{ cmake -S "$ROOT/examples/follow_branch" -B "$WORK/follow_branch" -DCMAKE_PREFIX_PATH="$INSTALLED" \
  -DPYTHON_EXECUTABLE=/usr/bin/python3 && cmake --build "$WORK/follow_branch"; } >"$WORK/example.log" 2>&1 ||
  fail "the example: $(tail -n 20 "$WORK/example.log")"
start_launch demo.launch scenario:=single_tree rviz:=false
"$WORK/follow_branch/devel/lib/follow_branch/follow_branch" >"$WORK/tips" 2>&1 &
example_pid=$!
wait_until 60 'the tip of a branch' grep -q 'tip of branch 20' "$WORK/tips"
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
