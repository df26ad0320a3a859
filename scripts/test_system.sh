#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs the two commands of the README in a bare Debian of its own, where the name of the machine does
# not resolve. Takes an hour; needs root and debootstrap.
# usage: scripts/test_system.sh RELEASE FOLDER [--no-display]
#   RELEASE  bullseye (Debian 11), bookworm (12) or trixie (13)
#   FOLDER   of the root, which is kept; its file picture.png is what the demo has shown
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

release=${1:?$(grep '^# usage' "$0")} root=$(realpath -m -- "${2:?no FOLDER}") option=${3:-}
[[ $release = @(bullseye|bookworm|trixie) ]] || fail "unknown release $release"
[[ $option = @(|--no-display) ]] || fail "unknown option $option"

# usage: inside COMMAND. Runs a shell command in the root.
inside() {
  unshare --uts --mount bash -c '
    hostname no-such-name
    mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev"
    chroot "$1" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin bash -c "cd /root/vegetation_sim && $2"
  ' inside "$root" "$1"
}

# usage: timed TEXT COMMAND. Runs a command in the root and says how long it has taken.
timed() {
  local start=$SECONDS
  inside "$2"
  say "$1: exit code 0, $(((SECONDS - start + 30) / 60)) min"
}

[ -d "$root/root" ] || debootstrap --variant=minbase --include=ca-certificates,git "$release" "$root"
rm -rf "$root/etc/hosts" "$root/root/vegetation_sim"
git clone --quiet --no-local "$ROOT" "$root/root/vegetation_sim"
if [ -z "$option" ]; then
  timed 'scripts/demo.sh' 'scripts/demo.sh forest --headless --seconds 5 --screenshot /picture.png'
fi
timed 'scripts/test.sh' "scripts/test.sh $option"

# The package in a catkin workspace, as the README has it for a robot.
if [ -n "$option" ]; then
  timed 'catkin_make' '
    mkdir -p ../workspace/src && ln -sfn "$PWD" ../workspace/src/vegetation_sim && cd ../workspace &&
    catkin_make -Dvegetation_sim_RVIZ=OFF && . devel/setup.bash && rospack find vegetation_sim'
fi

# Noetic's rviz has OGRE 1.9, which Debian 11 has beside that of its own rviz.
if [ "$release" = bullseye ] && [ -z "$option" ]; then
  timed 'displays with the headers of OGRE 1.9' '
    mkdir -p /tmp/ogre && cd /tmp/ogre && apt-get download -qq libogre-1.9-dev &&
    dpkg-deb -x libogre-1.9-dev_*.deb . &&
    cd /root/vegetation_sim && scripts/check_ogre.py /tmp/ogre/usr/include/OGRE'
fi
