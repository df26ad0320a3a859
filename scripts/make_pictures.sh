#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Makes the pictures in media/ anew: demo.webp, which moves, and one picture per line of the table
# below. Needs python3-pil and imagemagick. Open every picture afterwards.
# usage: scripts/make_pictures.sh [--out FOLDER] [NAME ...]; all pictures if no name is given
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
out=$ROOT/media
if [ "${1:-}" = --out ]; then
  out=$(realpath -- "$2")
  shift 2
fi
wanted=("$@")

# usage: pictures. One line per picture: name, scenario, time [s], and changes of its rviz
# configuration as scripts/picture_view.py reads them, separated by semicolons. other_robot has a
# scene of its own with the nodes of its scenario.
pictures() {
  cat <<'END'
demo         | demo         | 14 |
forest       | forest       | 8  | View=Among
grab_levels  | grab         | 9  |
push         | push         | 7.8| Forest/Leaves=true;Forest/Colours=natural
hedge        | hedge        | 9  |
meadow_robot | meadow_robot | 20 |
mowing       | mowing       | 50 |
harvest      | harvest      | 34 |
crowd        | crowd        | 12 |
hills        | hills        | 9  |
grove        | grove        | 8  |
reef         | reef         | 8  |
vineyard     | vineyard     | 3  |
scan         | crowd        | 12 |
other_robot  | crowd        | 14 | Robot/Robot Description=scout/robot_description;Robot/TF Prefix=scout;Forces/Enabled=true;View/Distance=7;View/Yaw=3.9;View/Pitch=0.22;View/Focal Point={X: 0, Y: 0.5, Z: 0.9}
END
}
FILM_SIZE='640 400' FILM_START=12 FILM_FRAMES=60 FILM_RATE=12 FILM_BYTES=4000000
PICTURE_SIZE='1280 900'

"$ROOT/scripts/build.sh" all rviz_film
use_space "$DEVEL"
. "$ROOT/scripts/launching.sh"
trap 'stop_process "$launch_pid"; stop_process "$display_pid"; rm -rf "$WORK"' EXIT
trap 'exit 130' INT TERM
SCREEN=2560x1800 start_display

is_wanted() { [ ${#wanted[@]} -eq 0 ] || [[ " ${wanted[*]} " == *" $1 "* ]]; }

# Prints the topics that must have reached the time of a picture.
topics_of() {
  sed -n 's/^forest:.*/forest\/state/p; s/^grass:.*/grass\/state/p; s/^crowd:.*/agents/p; s/^canopy:.*/canopy\/state/p' \
    "$ROOT/config/scenarios/$1.yaml"
}

# usage: start_scenario NAME SCENARIO. Launches what the picture NAME shows.
start_scenario() {
  local file=launch/demo.launch arguments
  arguments="<arg name='scenario' value='$2'/><arg name='rviz' value='false'/>"
  case $1 in
    scan) arguments+="<arg name='lidar' value='true'/>" ;;
    other_robot) file=test/nodes/robot/skid_steer.launch arguments='' ;;
  esac
  cat >"$WORK/picture.launch" <<END
<launch>
  <param name="use_sim_time" value="true"/>
  <include file="\$(find vegetation_sim)/$file">$arguments</include>
</launch>
END
  start_roslaunch "$WORK/picture.launch"
  wait_until 60 'the parameters of the scenario' rosparam get /use_sim_time
}

# usage: film NAME SCENARIO CHANGES SIZE START [FRAMES RATE]. Writes $WORK/NAME.png or
# $WORK/NAME-001.png and so on.
film() {
  local name=$1 scenario=$2 config=$ROOT/rviz/$2.rviz changes
  IFS=';' read -ra changes <<<"$3"
  [[ $name != @(scan|other_robot) ]] || config=$ROOT/rviz/scan.rviz
  python3 "$ROOT/scripts/picture_view.py" "$config" "${changes[@]}" >"$WORK/$name.rviz"
  say "Picture $name of scenario $scenario"
  start_scenario "$name" "$scenario"
  # shellcheck disable=SC2046,SC2086
  "$DEVEL/lib/vegetation_sim/rviz_film" "$WORK/$name.rviz" "$WORK/$name" $4 "${@:5}" \
    -- $(topics_of "$scenario") >"$WORK/film.log" 2>&1 || give_up "$name: $(tail -n 5 "$WORK/film.log")"
  stop_process "$launch_pid"
}

trim() { sed 's/^ *//; s/ *$//' <<<"$1"; }

mapfile -t rows < <(pictures)
for row in "${rows[@]}"; do
  IFS='|' read -r name scenario time changes <<<"$row"
  name=$(trim "$name")
  is_wanted "$name" || continue
  film "$name" "$(trim "$scenario")" "$(trim "$changes")" "$PICTURE_SIZE" "$(trim "$time")"
  convert "$WORK/$name.png" -quality 88 -sampling-factor 4:4:4 "$out/$name.jpg"
  say "Wrote $out/$name.jpg"
done
if is_wanted demo.webp; then
  film film demo '' "$FILM_SIZE" $FILM_START $FILM_FRAMES $FILM_RATE
  python3 "$ROOT/scripts/join_frames.py" "$out/demo.webp" $FILM_RATE $FILM_BYTES "$WORK"/film-*.png
fi
