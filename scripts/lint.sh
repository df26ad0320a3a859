#!/usr/bin/env bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs the static checks of the code.
# usage: scripts/lint.sh [format | tidy | catkin | structure | words | docs | api] ... Runs all checks
# if none is given. api writes the pages of the installed headers to build/api/html and fails if
# Doxygen has a warning.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/environment.sh"
cd "$ROOT"

code() { git ls-files 'include/*.h' 'src/*.h' 'src/*.cpp' 'test/*.h' 'test/*.cpp' 'bench/*.h' 'bench/*.cpp' 'scenes/*.h' 'scenes/*.cpp'; }

# usage: none_match PATTERN PATH ... Prints every line that matches, and fails if there is one.
none_match() {
  local pattern=$1
  shift
  ! git grep -nE "$pattern" -- "$@"
}

# Versions of clang-format differ, so only 14 checks (of Debian 12).
format() {
  if clang-format --version | grep -q 'version 14'; then
    code | xargs clang-format --dry-run -Werror
  else
    echo "not checked: clang-format 14 is needed, this is $(clang-format --version)"
  fi
}

# Only the core is checked, because the headers of ROS would take many minutes. Each source is checked
# on its own. clang cannot read the headers that g++ has precompiled.
tidy() {
  local commands
  commands=$(mktemp -d)
  cmake -S . -B "$commands/build" -G Ninja -Dvegetation_sim_UNITY=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 >"$commands/log" 2>&1 || { cat "$commands/log"; rm -r "$commands"; return 1; }
  sed 's/ -Winvalid-pch -include [^ ]*//' "$commands/build/compile_commands.json" >"$commands/compile_commands.json"
  git ls-files src/{canopy,core,crowd,dynamics,forest,grass,reference,sensors,terrain,tree,wind}'/*.cpp' |
    xargs -P "$(nproc)" -n 1 clang-tidy --quiet --extra-arg=-std=c++17 -p "$commands" 2>/dev/null || { rm -r "$commands"; return 1; }
  rm -r "$commands"
}

catkin() {
  # catkin_lint requires that the folder has the name of the package. It reads the development space
  # too, which holds programs that are built.
  local folder found
  folder=$(mktemp -d)
  ln -s "$ROOT" "$folder/vegetation_sim"
  found=$(catkin_lint --offline --strict -W2 --quiet "$folder/vegetation_sim" 2>&1 |
    grep -v "file 'devel/") || true
  rm -r "$folder"
  [ -z "$found" ] || { printf '%s\n' "$found"; return 1; }
}

# Checks folders, includes, public headers and file stems against docs/folders.yaml, the programs
# that launch files name, and the keys of package.xml.
structure() {
  local check
  for check in structure launch_files manifest; do python3 test/structure/check_$check.py || return 1; done
}

# Forbids debugging leftovers, readers of numbers that follow the locale of the user and, in the
# core, functions and containers whose results differ between machines. Code that only selects the
# level of detail of a picture may use the mathematics of the platform.
words() {
  local code_of_core=({include/vegetation_sim,src}/{canopy,core,crowd,dynamics,forest,grass,reference,terrain,tree,wind}
    ':!src/tree/mesh/geometry_level.cpp')
  none_match '\b(std::)?(rand|srand|random_device|[a-z]+_distribution)\b *[(<{]' src include &&
    none_match 'std::(sin|cos|tan|atan2?|exp|log|pow|cbrt|hypot)\(' "${code_of_core[@]}" &&
    none_match '\b(strto[df]|atof|sto[df]|[sf]scanf)\(' src include &&
    none_match 'unordered_(map|set)' "${code_of_core[@]}" &&
    none_match '(Duration\([0-9.]+\)\.sleep|sleep_for|usleep|time\.sleep)' test &&
    none_match 'DISABLED_|GTEST_SKIP|#if 0' test &&
    none_match 'march=native' CMakeLists.txt cmake
}

docs() { python3 test/docs/check_docs.py; }

# Doxygen before 1.9.3 does not distinguish faults from parameters without a sentence.
api() {
  local version
  version=$(doxygen --version)
  mkdir -p build/api
  if printf '1.9.3\n%s\n' "${version%% *}" | sort -C -V; then
    doxygen Doxyfile
  else
    echo "not checked: Doxygen 1.9.3 is needed, this is $version"
  fi
}

[ $# -gt 0 ] || set -- format tidy catkin structure words docs api
for check in "$@"; do
  case $check in
    format | tidy | catkin | structure | words | docs | api) "$check" ;;
    *) fail "unknown check $check" ;;
  esac
done
