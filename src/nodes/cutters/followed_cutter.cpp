// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/cutters/followed_cutter.h"

#include "nodes/cutters/followed_place.h"

namespace vegetation_sim {
namespace {

FollowedCutter readCutter(YamlSection& section) {
  FollowedCutter out;
  section.text("frame", out.frame);
  out.name = out.frame;
  section.text("name", out.name);
  if (out.frame.empty()) section.fault("frame", "is missing");
  readPlace(section, out);
  describe(section, out.cutter);
  section.number("thickest", out.thickest, "m", {0.0, 0.5});
  section.finish();
  return out;
}

}  // namespace

std::vector<FollowedCutter> readCutters(YamlSection& section) {
  return readFollowed(section, "cutters", readCutter);
}

}  // namespace vegetation_sim
