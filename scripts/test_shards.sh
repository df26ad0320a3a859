#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs a scene in four shards on four hosts, which are network namespaces with virtual links, beside
# the same scene in one node each on the host of the master. Walkers tread over borders, branches
# are held, pushed and cut through the wrong shard. The hashes of the shards have to add up to those
# of the single nodes at each tick, the people of two crowds and the points of a lidar have to be those
# of one, and two displays have to draw the same picture. Prints a table. If the kernel has no netem, a
# program delays and loses packets. Without the program rviz_frames (scripts/build.sh benches) there
# are no displays.
# usage: scripts/test_shards.sh [TICKS [DELAY [LOSS]]]  (600 ticks, 1ms and 0% each way)
# KEEP=FOLDER keeps logs and pictures.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"
use_space "$DEVEL"
export PATH=/usr/bin:/usr/sbin:/sbin:$PATH PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH=$ROOT/test/nodes/rigs:$ROOT/test/nodes/shards:$PYTHONPATH
if [ "${IN_NAMESPACE:-}" != 1 ]; then
  # In a network of its own, no node of another run answers.
  IN_NAMESPACE=1 exec unshare --user --map-root-user --net --mount --pid --fork --kill-child \
    --mount-proc "$0" "$@"
fi

HOSTS=4
MASTER=10.77.0.1
ticks=${1:-600} delay=${2:-1ms} loss=${3:-0%}
mount -t tmpfs none /run
mkdir /run/netns
. "$ROOT/scripts/launching.sh"
trap '[ -n "${KEEP:-}" ] && cp -r "$WORK" "$KEEP"; rm -rf "$WORK"' EXIT
unset ROS_HOSTNAME
export ROS_MASTER_URI=http://$MASTER:11311 ROS_IP=$MASTER ROS_HOME=$WORK/ros
ip link set lo up
ip link add hub type bridge
ip address add $MASTER/24 dev hub
ip link set hub up
netem=yes pairs=()
for host in $(seq $HOSTS); do
  ip netns add "host_$host"
  ip link add "link_$host" type veth peer name eth0 netns "host_$host"
  ip link set "link_$host" up
  ip -n "host_$host" link set lo up
  ip -n "host_$host" address add "10.77.0.1$host/24" dev eth0
  ip -n "host_$host" link set eth0 up
  for command in "tc qdisc add dev link_$host" "tc -n host_$host qdisc add dev eth0"; do
    $command root netem delay "$delay" loss "$loss" 2>/dev/null || netem=no
  done
done
for host in $(seq $HOSTS); do
  if [ $netem = yes ]; then
    ip link set "link_$host" master hub
  else
    ip link add "wire_$host" type veth peer name "port_$host"
    ip link set "wire_$host" up
    ip link set "port_$host" master hub up
    pairs+=("link_$host:wire_$host")
  fi
done
if [ $netem = no ]; then
  python3 test/nodes/shards/hosts/delayed_links.py \
    "$(python3 -c "print(1e-3 * ${delay%ms})")" "$(python3 -c "print(1e-2 * ${loss%\%})")" \
    "${pairs[@]}" 2>"$WORK/links.log" &
fi
say "links with a delay of $delay and a loss of $loss each way, netem: $netem"

# usage: start HOST (0: that of the master) TYPE NAME [ARGUMENT ...]
start() {
  local host=$1 type=$2 name=$3 enter=()
  shift 3
  [ "$host" = 0 ] || enter=(env ROS_IP="10.77.0.1$host" ip netns exec "host_$host")
  "${enter[@]}" "$DEVEL/lib/vegetation_sim/$type" "__name:=$name" "$@" \
    >"$WORK/$type.$name.log" 2>&1 &
}

roscore -p 11311 >"$WORK/roscore.log" 2>&1 &
until rosparam set /use_sim_time true 2>/dev/null; do sleep 0.2; done
scene=$ROOT/test/nodes/shards/hosts.yaml
# usage: start_pair HOST NAMESPACE SUFFIX INDEX COUNT. Starts a shard of the forest and of the grass.
# A request waits for less than the time without a link, so that it always ends with an error then.
start_pair() {
  local kind name
  for kind in forest grass; do
    name=${kind}_$3
    rosparam load "$ROOT/test/nodes/shards/hosts_$kind.yaml" "$2$name"
    rosparam set "$2$name/shard" "{index: $4, count: $5, wait: 3.0}"
    case $kind in forest) type=forest_animator ;; *) type=grass_field ;; esac
    start "$1" "$type" "$name" "__ns:=$2" "_scenario:=$scene" wind:=/wind tread:=/tread
  done
}
for index in $(seq 0 $((HOSTS - 1))); do start_pair $((index + 1)) / "$index" "$index" "$HOSTS"; done
start_pair 0 /whole/ all 0 1
# usage: start_crowd HOST NAMESPACE SUFFIX INDEX COUNT
start_crowd() {
  rosparam load "$ROOT/test/nodes/shards/hosts/crowd.yaml" "$2crowd_$3"
  rosparam set "$2crowd_$3/shard" "{index: $4, count: $5}"
  start "$1" agent_crowd "crowd_$3" "__ns:=$2" "_scenario:=$scene" forest/layout:=none/layout \
    grass/cover/resistance:=none/resistance
}
start_crowd 1 / 0 0 2
start_crowd 3 / 1 1 2
start_crowd 0 /whole/ all 0 1
start 0 wind_broadcaster wind_broadcaster "_scenario:=$scene"
for namespace in / /whole/; do
  start 0 vegetation_scanner scanner "__ns:=$namespace" wind:=/wind _frame_id:=map
done

# usage: start_display_of HOST NAMESPACE NAME. Starts a display that draws when the clock has ended.
start_display_of() {
  start "$1" rviz_frames "$3" "__ns:=$2" wind:=/wind "$WORK/hosts.rviz" --settle 1 --seconds 1 \
    --after "$WORK/end" --picture "$WORK/$3.png"
}
displays=()
if [ -x "$DEVEL/lib/vegetation_sim/rviz_frames" ]; then
  start_display
  displays=("$WORK")
  sed 's/^\( *Distance:\).*/\1 24/; s/^\( *Fixed Frame:\).*/\1 map/' rviz/demo.rviz >"$WORK/hosts.rviz"
  start_display_of 4 / shards
  start_display_of 0 /whole/ whole
else
  say 'without displays: rviz_frames is not built'
fi
python3 test/nodes/shards/hosts/drive_hosts.py "$ticks" "$HOSTS" "${displays[@]}" || {
  tail -n 5 "$WORK"/*.log >&2
  fail 'the shards are not one world'
}
