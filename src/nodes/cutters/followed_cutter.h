// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grass/tread/cutter.h"

namespace vegetation_sim {

class YamlSection;

/// A cutting tool that the node finds by itself.
struct FollowedCutter {
  std::string name;
  std::string frame;                  ///< tf frame, whose x axis is the heading, in the x-y plane
  Vec3 offset{Vec3::Zero()};          ///< of the middle of the footprint in that frame [m]
  std::optional<double> height_gate;  ///< none: the node's [m]
  grass::Cutter cutter;
  double thickest{0.02};  ///< radius of a branch that it cuts [m]
};
/// Reads the list `cutters`; adds faults to the section.
std::vector<FollowedCutter> readCutters(YamlSection& section);

}  // namespace vegetation_sim
