#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Takes a series of screenshots of the scenario "grab" as a user would; they must differ. Then takes
# one of a scenario file.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$ROOT/scripts/demo.sh" grab --headless --seconds 8 --screenshot "$folder/grab.png" --series 2
for number in 1 2; do
  [ -s "$folder/grab-$number.png" ] || fail "no picture grab-$number.png"
done
! cmp -s "$folder/grab-1.png" "$folder/grab-2.png" || fail 'both pictures of the series are the same'

# A scenario of the user's own.
mkdir "$folder/scenes"
cp -r "$ROOT/config/species" "$folder"
cat >"$folder/scenes/own.yaml" <<END
forest:
  species: [{name: birch}]
  tiles: [{x: -8, y: -8, size: 16, count: 30, mix: {birch: 1}}]
END
"$ROOT/scripts/demo.sh" "$folder/scenes/own.yaml" --headless --seconds 2 --screenshot "$folder/own.png"
[ -s "$folder/own.png" ] || fail 'no picture own.png'
if "$ROOT/scripts/demo.sh" "$folder/scenes/none.yaml" --headless; then
  fail 'a scenario file that does not exist was accepted'
fi
