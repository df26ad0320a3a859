#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Takes a series of screenshots of the scenario "grab" as a user would; they must differ.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$ROOT/scripts/demo.sh" grab --headless --seconds 8 --screenshot "$folder/grab.png" --series 2
for number in 1 2; do
  [ -s "$folder/grab-$number.png" ] || fail "no picture grab-$number.png"
done
! cmp -s "$folder/grab-1.png" "$folder/grab-2.png" || fail 'both pictures of the series are the same'
