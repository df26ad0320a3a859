// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim {

/// Largest number of sources, and of cutters, that a node follows.
constexpr std::size_t MOST_FOLLOWED = 256;

/// Reads where a source or a cutter is in its frame.
template <class Followed>
void readPlace(YamlSection& section, Followed& out) {
  if (!out.frame.empty() && out.frame[0] == '/')
    section.fault("frame", "= " + inQuotes(out.frame) + " begins with '/'");
  section.vector("offset", out.offset, "m", {-100.0, 100.0});
  double height_gate = 0.0;
  section.number("height_gate", height_gate, "m", {0.0, 1000.0});
  if (section.has("height_gate")) out.height_gate = height_gate;
}

/// Reads a list of sources or cutters, whose names are unique.
template <class Item>
std::vector<Item> readFollowed(YamlSection& section, const char* key, Item (*read)(YamlSection&)) {
  std::vector<Item> out;
  std::set<std::string> names;
  for (YamlSection& entry : section.sections(key)) {
    out.push_back(read(entry));
    if (!names.insert(out.back().name).second)
      section.fault(key, "names " + inQuotes(out.back().name) + " twice");
  }
  if (out.size() > MOST_FOLLOWED)
    section.fault(key, "are " + std::to_string(out.size()) + ", allowed are " +
                           std::to_string(MOST_FOLLOWED));
  return out;
}

}  // namespace vegetation_sim
