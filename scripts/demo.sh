#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Installs missing dependencies, builds the package and shows a scenario in rviz.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

usage() {
  cat <<END
usage: scripts/demo.sh [SCENARIO] [--headless] [--seconds N] [--screenshot FILE] [--series N] [--view NAME]
  SCENARIO           one of: $(scenarios) (forest if none is given),
                     or the path of a scenario file, which ends in .yaml
  --headless         uses a virtual display and its own ROS master; succeeds only if rviz shows a
                     picture and no node dies
  --seconds N        ends after N seconds (20 if headless, else when rviz is closed)
  --screenshot FILE  picture of the rviz window at the end; with --headless
  --view NAME        starts with this saved view of the rviz configuration; with --headless
  --series N         N pictures instead, at equal times up to the end, -1 to -N before FILE's ending
END
}

scenarios() { (cd "$ROOT/config/scenarios" && ls -- *.yaml 2>/dev/null | sed 's/\.yaml$//' | paste -sd ' '); }

refuse() {
  printf 'demo.sh: %s\n' "$*" >&2
  usage >&2
  exit 2
}

parse() {
  scenario= headless=false seconds= screenshot= view= series=1
  while [ $# -gt 0 ]; do
    case $1 in
      --headless) headless=true ;;
      --seconds | --screenshot | --series | --view)
        [ $# -ge 2 ] || refuse "$1 requires a value"
        printf -v "${1#--}" %s "$2"
        shift
        ;;
      -h | --help) usage; exit 0 ;;
      -*) refuse "unknown option $1" ;;
      *)
        [ -z "$scenario" ] || refuse "more than one scenario: $1"
        scenario=$1
        ;;
    esac
    shift
  done
  scenario=${scenario:-forest}
  if [[ $scenario = *.yaml ]]; then
    [ -f "$scenario" ] || refuse "no scenario file $scenario"
    arguments=(scenario:=own "scenario_file:=$(realpath -- "$scenario")")
  else
    [ -e "$ROOT/config/scenarios/$scenario.yaml" ] || refuse "unknown scenario $scenario"
    arguments=(scenario:="$scenario")
  fi
  [[ $seconds =~ ^[0-9]*$ && ! $seconds =~ ^0+$ ]] || refuse "--seconds $seconds is not a whole number above 0"
  [[ $series =~ ^[0-9]{1,3}$ && ! $series =~ ^0+$ ]] || refuse "--series $series is not within 1 to 999"
  series=$((10#$series))
  [ "$series" = 1 ] || [ -n "$screenshot" ] || refuse '--series requires --screenshot'
  [ -z "$screenshot" ] || $headless || refuse '--screenshot requires --headless'
  [ -z "$view" ] || $headless || refuse '--view requires --headless'
  $headless || [ -n "${DISPLAY:-}" ] || refuse 'no display is available; add --headless'
  if [ -n "$screenshot" ]; then
    screenshot=$(realpath -m -- "$screenshot")
    [ -d "$(dirname "$screenshot")" ] || refuse "no folder for --screenshot $screenshot"
  fi
}

rviz_config() {
  local own=$ROOT/rviz/$scenario.rviz
  [ -e "$own" ] && echo "$own" || echo "$ROOT/rviz/default.rviz"
}

# usage: seen_from NAME. Prints the path of a copy of the rviz configuration that starts with the
# saved view NAME.
seen_from() {
  python3 - "$(rviz_config)" "$1" >"$WORK/view.rviz" <<'END' || fail "--view $1: $(rviz_config) has no saved view of that name"
import sys, yaml
with open(sys.argv[1]) as file:
    config = yaml.safe_load(file)
views = config['Visualization Manager']['Views']
views['Current'] = {view['Name']: view for view in views['Saved'] or []}[sys.argv[2]]
yaml.safe_dump(config, sys.stdout)
END
  echo "$WORK/view.rviz"
}

# A window that is blank or shows only menus has few colours in its middle.
check_picture() {
  local colours
  colours=$(convert "$1" -gravity center -crop 60%x60%+0+0 +repage -format %k info:)
  [ "$colours" -ge 200 ] || give_up "the picture is blank: $colours colours in its middle"
  say "Picture of $(identify -format '%w x %h' "$1") pixels, $colours colours in its middle"
}

# usage: run_until TIME. Waits until the time [us] while it checks that the launch still runs.
run_until() {
  while [ "${EPOCHREALTIME/[.,]/}" -lt "$1" ]; do
    check_launch
    sleep 0.1
  done
}

take_picture() {
  local file=$screenshot
  import -window "$(rviz_window)" "png:$WORK/picture.png"
  check_launch
  check_picture "$WORK/picture.png"
  [ "$series" = 1 ] || file=${screenshot%.*}-$1.${screenshot##*.}
  [ -z "$file" ] || { cp "$WORK/picture.png" "$file" && say "Wrote $file"; }
}

run_headless() {
  . "$ROOT/scripts/launching.sh"
  trap 'stop_process "$launch_pid"; stop_process "$display_pid"; rm -rf "$WORK"' EXIT
  trap 'exit 130' INT TERM
  local config
  config=$(if [ -n "$view" ]; then seen_from "$view"; else rviz_config; fi)
  start_display
  say "Showing $scenario on display $DISPLAY"
  start_launch demo.launch "${arguments[@]}" rviz_config:="$config" rviz_args:=--disable-anti-aliasing
  wait_until 120 'the rviz window' rviz_window
  wait_until 60 'a message on forest/state' topic_flows /forest/state
  say "Running for ${seconds:-20} s"
  local start=${EPOCHREALTIME/[.,]/} number
  for ((number = 1; number <= series; number++)); do
    run_until $((start + 10#${seconds:-20} * 1000000 * number / series))
    take_picture "$number"
  done
}

parse "$@"
"$ROOT/scripts/install_dependencies.sh"
"$ROOT/scripts/build.sh"
use_space "$DEVEL"
if $headless; then
  run_headless
else
  launch=(roslaunch vegetation_sim demo.launch "${arguments[@]}" rviz_config:="$(rviz_config)")
  [ -z "$seconds" ] || launch=(timeout --foreground --preserve-status -s INT "$seconds" "${launch[@]}")
  exec "${launch[@]}"
fi
