#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Starts shards.launch on three hosts, which are network namespaces: roslaunch starts the shards of two
# of them by ssh. Checks where the nodes run, that each answers for trees of the others, and that they
# end with the launch. To be run before a release, as root.
# usage: scripts/test_remote_shards.sh
# Needs sshd (Debian: openssh-server).
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"
use_space "$DEVEL"
export PATH=/usr/bin:/usr/sbin:/sbin:$PATH
if [ "${IN_NAMESPACE:-}" != 1 ]; then
  [ "$(id -u)" = 0 ] || fail 'sshd has to be started by root'
  # In a network of its own, no node of another run answers.
  IN_NAMESPACE=1 exec unshare --net --mount --pid --fork --kill-child --mount-proc "$0" "$@"
fi
mount -t tmpfs none /run
mkdir -p /run/netns /run/sshd
. "$ROOT/scripts/launching.sh"
trap 'cat "$LOG" >&2; rm -rf "$WORK"' EXIT
MASTER=10.77.0.1
ip link set lo up
ip link add hub type bridge
ip address add $MASTER/24 dev hub
ip link set hub up

# The same key lets the master in, and is that of the hosts.
export HOME=$WORK
mkdir -m 700 "$WORK/.ssh"
ssh-keygen -q -t rsa -m PEM -N '' -f "$WORK/.ssh/id_rsa"
cat >"$WORK/sshd_config" <<CONF
HostKey $WORK/.ssh/id_rsa
AuthorizedKeysFile $WORK/.ssh/id_rsa.pub
PermitRootLogin prohibit-password
StrictModes no
UsePAM no
PidFile none
CONF
# What a host runs before each program: its workspace and its address.
cat >"$WORK/env.sh" <<ENV
#!/bin/bash
. "$DEVEL/setup.bash"
export PATH=/usr/bin:\$PATH ROS_HOME=$WORK/ros
export ROS_IP=\$(ip -o -4 address show dev eth0 | sed 's/.*inet \([0-9.]*\).*/\1/')
exec "\$@"
ENV
chmod +x "$WORK/env.sh"
for host in 1 2; do
  ip netns add "host_$host"
  ip link add "link_$host" type veth peer name eth0 netns "host_$host"
  ip link set "link_$host" up master hub
  ip -n "host_$host" link set lo up
  ip -n "host_$host" address add "10.77.0.1$host/24" dev eth0
  ip -n "host_$host" link set eth0 up
  ip netns exec "host_$host" /usr/sbin/sshd -f "$WORK/sshd_config" -E "$WORK/sshd_$host.log"
done

unset ROS_HOSTNAME
export ROS_IP=$MASTER ROS_MASTER_URI=http://$MASTER:11311 ROS_HOME=$WORK/ros ROSLAUNCH_SSH_UNKNOWN=1
say 'Launching four shards on two hosts'
roslaunch vegetation_sim shards.launch scenario:=forest count:=4 hosts:='10.77.0.11 10.77.0.12' grass:=false \
  canopy:=false crowd:=false env_loader:="$WORK/env.sh" >"$LOG" 2>&1 &
launch_pid=$!

# Succeeds if each shard runs on its host.
are_placed() {
  local shard
  for shard in 0 1 2 3; do
    rosnode list -a | grep "^http://10.77.0.1$((1 + shard % 2)):[0-9]*/[[:space:]]*/forest_$shard\$" || return 1
  done
}
# Succeeds if each shard answers for trees of all.
do_answer() {
  local shard tree
  for shard in 0 1 2 3; do
    for tree in 0 40 80 120; do
      [[ $(rosservice call "/forest_$shard/get_tree" "{tree: $tree}") = *'success: True'* ]] || return 1
    done
  done
}
wait_until 120 'shards on their hosts' are_placed
rosnode list -a | sort
wait_until 60 'answers for trees of all' do_answer
say 'Each shard answers for trees of all; ending the launch'
stop_process "$launch_pid"
! pgrep -f "$DEVEL/lib/vegetation_sim/forest_animator" >/dev/null || fail 'a node on another host did not end'
trap 'rm -rf "$WORK"' EXIT
say 'The nodes on the other hosts have ended'
