// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

/// MOVE: from where it was, or down there; PLACE: down there, a new pass; LIFT: off the ground;
/// STROKE: down at the start, to the position, and off.
enum class TreadAction : int { MOVE = 0, PLACE = 1, LIFT = 2, STROKE = 3 };

/// A source of treading moved.
struct TreadInput {
  std::string source;  ///< its name
  TreadAction action{TreadAction::MOVE};
  Vec3 start{Vec3::Zero()};     ///< of a STROKE, world [m]
  Vec3 position{Vec3::Zero()};  ///< world [m]
  double height_gate{0.3};      ///< higher above the ground it treads nothing [m]
  Vec3 velocity{Vec3::Zero()};  ///< world [m/s]; zero: from its last two positions
  TreadLaw law;
  std::string body_frame;  ///< of the body that feels the drag; empty: nobody asks
};
/// Adds a fault for whatever is wrong; `context` names the input.
void check(const TreadInput& input, const std::string& context, Faults& faults);

}  // namespace vegetation_sim::grass
